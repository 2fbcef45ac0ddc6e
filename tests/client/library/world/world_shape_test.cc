// Goal:   a shape is published before the first agent that has it, once for any number of agents,
//         and is removed after the last one.
// Method: a network under the test's control; the kinds of all samples written, in order.
#include <gtest/gtest.h>

#include <optional>

#include "client/library/world/shape_publisher.h"
#include "collision/shape.h"
#include "idl/limits.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

/// A strip of this many triangles: 16 bytes, 24 per vertex, 12 per triangle.
std::shared_ptr<const Shape> Strip(std::uint32_t triangles) {
  Triangles strip;
  for (std::uint32_t i = 0; i < triangles + 2; ++i) {
    strip.vertices_m.push_back({0.01 * i, i % 2 * 0.5, 0});
  }
  for (std::uint32_t i = 0; i < triangles; ++i) strip.indices.push_back({i, i + 1, i + 2});
  return Shape::Make(strip);
}

AgentDescription Ship(const std::string& name, std::shared_ptr<const Shape> shape) {
  return {.name = name,
          .radius_m = 100,
          .acceleration_max_m_s2 = 0,
          .angular_acceleration_max_rad_s2 = 0.5,
          .shape = std::move(shape)};
}

class WorldShapeTest : public testing::Test {
 protected:
  /// What was written since the last call: p for a part, d for a description, s, c for states and
  /// clock, r for the removal of an agent, x for that of a shape.
  std::string Kinds() {
    std::string kinds;
    for (; seen_ < network_->written.size(); ++seen_) {
      const v1::Input& input = network_->written[seen_];
      kinds += input.has_shape_part()          ? 'p'
               : input.has_agent_description() ? 'd'
               : input.has_agent_states()      ? 's'
               : input.has_simulator_clock()   ? 'c'
               : input.has_agent_removal()     ? 'r'
               : input.has_shape_removal()     ? 'x'
                                               : '?';
    }
    return kinds;
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  World world_ = ConnectTo(network_);
  std::size_t seen_ = 0;
};

TEST_F(WorldShapeTest, PartsComeFirstAndAreWhole) {
  const auto shape = Strip(4000);
  ASSERT_EQ(shape->bytes().size(), 16u + 24 * 4002 + 12 * 4000);
  const Agent ship = world_.AddAgent(Ship("ship", shape), {});
  world_.Publish(0);
  EXPECT_EQ(Kinds(), "pppdsc");
  std::string bytes;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const v1::ShapePart& part = network_->written[i].shape_part();
    EXPECT_EQ(part.simulator_id(), SimulatorId(kSimulator));
    EXPECT_EQ(part.run(), kRun);
    EXPECT_EQ(part.content_hash(), shape->hash());
    EXPECT_EQ(part.part(), i);
    EXPECT_EQ(part.parts(), 3u);
    EXPECT_EQ(part.total_bytes(), shape->bytes().size());
    EXPECT_LE(part.bytes().size(), wire::kShapePartBytes);
    bytes += part.bytes();
  }
  EXPECT_EQ(bytes, shape->bytes());
  EXPECT_EQ(network_->written[3].agent_description().shape_hash(), shape->hash());
  EXPECT_EQ(network_->written[3].agent_description().angular_acceleration_max_rad_s2(), 0.5);
}

// A last part without bytes would be refused.
TEST_F(WorldShapeTest, PartsEndWithTheBytes) {
  for (std::uint32_t triangles = 1362; triangles < 1368; ++triangles) {
    const auto shape = Strip(triangles);
    std::optional<Agent> ship = world_.AddAgent(Ship("ship", shape), {});
    const std::size_t parts = (shape->bytes().size() - 1) / wire::kShapePartBytes + 1;
    EXPECT_EQ(Kinds(), std::string(parts, 'p') + "d");
    for (const v1::Input& input : network_->written) {
      EXPECT_TRUE(!input.has_shape_part() || !input.shape_part().bytes().empty());
    }
    ship.reset();
    network_->written.clear();
    seen_ = 0;
  }
}

TEST_F(WorldShapeTest, ManyAgentsShareOneShapeAndTheLastRemovesIt) {
  std::vector<Agent> ships;
  for (int i = 0; i < 3; ++i) {
    // Made anew each time: content counts, not the object.
    ships.push_back(world_.AddAgent(Ship("ship", Strip(5)), {}));
  }
  const Agent ball =
      world_.AddAgent({.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 0}, {});
  EXPECT_EQ(Kinds(), "pdddd");
  EXPECT_EQ(network_->written.back().agent_description().shape_hash(), "");
  ships.pop_back();
  ships.pop_back();
  EXPECT_EQ(Kinds(), "rr");
  ships.pop_back();
  EXPECT_EQ(Kinds(), "rx");
  const v1::ShapeRemoval& removal = network_->written.back().shape_removal();
  EXPECT_EQ(removal.simulator_id(), SimulatorId(kSimulator));
  EXPECT_EQ(removal.shape(), kIncarnation);
  EXPECT_EQ(network_->flushed, network_->written.size());
}

TEST_F(WorldShapeTest, AReusedShapeIsPublishedAgain) {
  const auto shape = Strip(5);
  { const Agent ship = world_.AddAgent(Ship("ship", shape), {}); }
  EXPECT_EQ(Kinds(), "pdrx");
  { const Agent ship = world_.AddAgent(Ship("ship", shape), {}); }
  EXPECT_EQ(Kinds(), "pdrx");
}

// The service must never have a description whose shape was removed.
TEST_F(WorldShapeTest, AChangeOfShapePublishesTheNewOneFirstAndRemovesTheOldOneLast) {
  Agent ship = world_.AddAgent(Ship("ship", Strip(5)), {});
  EXPECT_EQ(Kinds(), "pd");
  ship.SetDescription(Ship("renamed", Strip(5)));
  EXPECT_EQ(Kinds(), "d");
  ship.SetDescription(Ship("ship", Strip(6)));
  EXPECT_EQ(Kinds(), "pdx");
  EXPECT_EQ(network_->written.back().shape_removal().shape(), kIncarnation);
  ship.SetDescription(Ship("ship", nullptr));
  EXPECT_EQ(Kinds(), "dx");
  ship.SetDescription(Ship("ship", Strip(6)));
  EXPECT_EQ(Kinds(), "pd");
}

TEST_F(WorldShapeTest, ARadiusThatIsLeftOutIsThatOfTheShape) {
  AgentDescription description = Ship("ship", Strip(5));
  description.radius_m.reset();
  const Agent ship = world_.AddAgent(description, {});
  EXPECT_EQ(network_->written.back().agent_description().radius_m(), description.shape->radius_m());
}

TEST_F(WorldShapeTest, ARefusedDescriptionWritesNothing) {
  AgentDescription small = Ship("ship", Strip(5));
  small.radius_m = 0.01;
  EXPECT_THROW(world_.AddAgent(small, {}), std::invalid_argument);
  EXPECT_EQ(Kinds(), "");
  Agent ship = world_.AddAgent(Ship("ship", Strip(5)), {});
  EXPECT_THROW(ship.SetDescription(small), std::invalid_argument);
  EXPECT_EQ(Kinds(), "pd");
  { const Agent gone = std::move(ship); }
  EXPECT_EQ(Kinds(), "rx");
}

// The successor of a killed program waits until the service has given up its predecessor.
TEST_F(WorldShapeTest, WhenTheNameIsFreeShapesAreRepeatedToo) {
  const Agent ship = world_.AddAgent(Ship("ship", Strip(5)), {});
  const Agent other = world_.AddAgent(Ship("other", Strip(5)), {});
  std::optional<Agent> gone = world_.AddAgent(Ship("gone", Strip(6)), {});
  gone.reset();
  world_.Publish(0);
  Kinds();
  network_->Report(kRun - 1, 1, true);
  network_->Report(kRun - 1, 1, false);
  world_.Poll();
  EXPECT_EQ(Kinds(), "prddssc");
}

TEST_F(WorldShapeTest, TheEndOfAWorldRemovesTheShapesOfTheAgentsThatLeaveWithIt) {
  for (const OnLeave on_leave : {OnLeave::kLeave, OnLeave::kRemove}) {
    std::optional<Agent> ship;
    {
      World world = ConnectTo(network_, {.on_leave = on_leave});
      ship = world.AddAgent(Ship("ship", Strip(5)), {});
    }
    ship.reset();
    EXPECT_EQ(Kinds(), on_leave == OnLeave::kLeave ? "pd" : "pdrx");
  }
}

}  // namespace
}  // namespace collision::client
