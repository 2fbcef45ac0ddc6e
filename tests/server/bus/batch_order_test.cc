#include "server/bus/batch_order.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/shapes/shapes.h"

namespace collision::server {
namespace {

// Goal:   a batch has one order, whatever the order of arrival of different writers; a writer's own
//         order stays.
// Method: a shuffled batch against the order that the header states; sorting again changes nothing.
TEST(BatchOrder, SortsByWhatItStates) {
  const std::vector<v1::Input> sorted = {
      Removal(1, "a", 0),           From(1, Description("a", 0)), From(1, Description("a", 1)),
      From(1, State(0, 0, 1), "a"), From(1, ClockOf("a", 0)),     Liveliness(1, "a", false),
  };
  for (const std::vector<int>& order :
       std::vector<std::vector<int>>{{5, 4, 3, 2, 0, 1}, {0, 1, 2, 3, 4, 5}, {3, 0, 5, 1, 4, 2}}) {
    std::vector<v1::Input> batch;
    for (const int i : order) batch.push_back(sorted[i]);
    SortBatch(&batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      EXPECT_EQ(batch[i].SerializeAsString(), sorted[i].SerializeAsString()) << i;
    }
  }
}

// Goal:   an agent's end comes after the last message of its simulator, and before the description
//         that reuses its slot; its simulator's end comes last.
TEST(BatchOrder, AnAgentEndsAfterItsLastState) {
  const std::vector<v1::Input> arrived = {
      Removal(1, "a", 3),           Liveliness(1, "a", false),    Removal(2, "a", 1),
      From(1, State(0, 0, 1), "a"), From(1, ClockOf("a", 0)),     Removal(1, "a", 0),
      From(1, Description("a", 1)), From(1, Description("b", 0)), From(1, Description("b", 3)),
      Removal(3, "a", 1),
  };
  std::vector<int> order = {2, 6, 3, 4, 5, 9, 0, 1};
  const std::vector<int> of_b = {7, 8};
  order.insert(SimulatorId("a") < SimulatorId("b") ? order.end() : order.begin(), of_b.begin(),
               of_b.end());
  std::vector<v1::Input> batch = arrived;
  for (int times = 0; times < 2; ++times) {
    SortBatch(&batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      EXPECT_EQ(batch[i].SerializeAsString(), arrived[order[i]].SerializeAsString()) << i;
    }
  }
}

v1::Input ReadyOf(const std::string& hash) {
  v1::Input input;
  input.mutable_shape_ready()->set_content_hash(hash);
  return input;
}

// Goal:   a shape that is ready counts for everything in its batch; shapes come after descriptions;
//         removals of shapes come after those of agents, but for parts that are written anew.
TEST(BatchOrder, ShapesThatAreReadyComeFirst) {
  const std::vector<v1::ShapePart> parts = PartsOf("a", EncodeShape(Cube(1, UnusedFor(2))));
  const std::vector<v1::Input> removals = RemovalsOf(1, parts);
  const std::vector<v1::Input> sorted = {
      ReadyOf("h"),
      ReadyOf("g"),
      From(1, Description("a", 0)),
      removals[1],
      From(1, parts[1]),
      From(1, parts[0]),
      From(1, State(0, 0, 1), "a"),
      From(1, ClockOf("a", 0)),
      Removal(1, "a", 3),
      removals[0],
      removals[2],
      Liveliness(1, "a", false),
  };
  for (const std::vector<int>& order : std::vector<std::vector<int>>{
           {11, 8, 3, 4, 5, 9, 7, 6, 2, 10, 0, 1}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}) {
    std::vector<v1::Input> batch;
    for (const int i : order) batch.push_back(sorted[i]);
    for (int times = 0; times < 2; ++times) {
      SortBatch(&batch);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        EXPECT_EQ(batch[i].SerializeAsString(), sorted[i].SerializeAsString()) << i;
      }
    }
  }
}

}  // namespace
}  // namespace collision::server
