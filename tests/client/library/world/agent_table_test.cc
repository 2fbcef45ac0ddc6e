// Goal:   a jump that is staged reaches the service, also if a later state replaces it; and what a
//         clock counts is there to be read by a service that comes later.
#include "client/library/world/agent_table.h"

#include <gtest/gtest.h>

#include <vector>

namespace collision::client {
namespace {

// The jump has happened, although the clock never came to its stamp.
TEST(AgentTable, AJumpSurvivesALaterStagedState) {
  AgentTable table("simulator", 1, 1, 1, {});
  const AgentId ball = table.Add({.name = "ball"}, {.stamp_ns = 0});
  EXPECT_FALSE(table.TakeDue(0).at(0).states(0).discontinuity());
  table.Stage(ball, {.stamp_ns = 1, .discontinuity = true});
  table.Stage(ball, {.stamp_ns = 2, .position_m = {51, 0, 0}});
  EXPECT_TRUE(table.TakeDue(1).empty());
  const v1::AgentState sent = table.TakeDue(2).at(0).states(0);
  EXPECT_EQ(sent.position_m().x(), 51);
  EXPECT_TRUE(sent.discontinuity());
}

TEST(AgentTable, AClockNamesOnlyStatesThatStand) {
  AgentTable table("simulator", 1, 1, 1, {});
  const AgentId first = table.Add({.name = "first"}, {.stamp_ns = 0});
  const AgentId second = table.Add({.name = "second"}, {.stamp_ns = 0});
  table.TakeDue(0);
  EXPECT_EQ(table.Clock(0, 0, true).states_sequence(), 2u);
  table.Remove(second);
  EXPECT_EQ(table.Clock(0, 0, true).states_sequence(), 2u) << "it stays in its chunk for now";
  table.TakeDue(1);
  EXPECT_EQ(table.Clock(1, 0, true).states_sequence(), 1u);
  table.Remove(first);
  table.TakeDue(2);
  EXPECT_EQ(table.Clock(2, 0, true).states_sequence(), 0u);
  EXPECT_EQ(table.stated(), 0u);
}

// Goal:   of all descriptions and removals the newest has the sequence that the clock names.
TEST(AgentTable, ARemovalIsOneOfTheDescriptions) {
  AgentTable table("simulator", 1, 1, 77, {});
  table.Add({.name = "first"}, {});
  const AgentId second = table.Add({.name = "second"}, {});
  const v1::AgentRemoval removal = table.Remove(second);
  EXPECT_EQ(removal.slot(), second.slot);
  EXPECT_EQ(removal.incarnation(), 77u);
  EXPECT_EQ(removal.sequence(), 3u);
  EXPECT_EQ(table.Clock(0, 0, true).descriptions_sequence(), 3u);
  ASSERT_EQ(table.Removals().size(), 1u);
  EXPECT_EQ(table.Removals()[0].sequence(), 3u);
  EXPECT_EQ(table.Descriptions().size(), 1u);
  table.SetRun(9);
  EXPECT_EQ(table.Descriptions()[0].run(), 9u);
  EXPECT_EQ(table.Clock(0, 0, true).run(), 9u);
}

// Goal:   a clock that names the highest sequence counts when all states before it have come, since
//         one topic keeps its order: whatever order they are set in, and when they are repeated.
TEST(AgentTable, TheHighestSequenceIsSentLast) {
  AgentTable table("simulator", 1, 1, 1, {.chunk_size = 1});
  std::vector<AgentId> balls;
  for (int i = 0; i < 3; ++i) balls.push_back(table.Add({.name = "ball"}, {.stamp_ns = 0}));
  table.TakeDue(0);
  const auto expect_rising = [](const std::vector<v1::AgentStates>& chunks) {
    for (std::size_t i = 1; i < chunks.size(); ++i) {
      EXPECT_LT(chunks[i - 1].states(0).sequence(), chunks[i].states(0).sequence());
    }
  };
  for (const std::size_t i : {2, 0, 1}) table.Stage(balls[i], {.stamp_ns = 1});
  const std::vector<v1::AgentStates> due = table.TakeDue(1);
  ASSERT_EQ(due.size(), 3u);
  expect_rising(due);
  table.Stage(balls[0], {.stamp_ns = 2});
  table.TakeDue(2);
  ASSERT_EQ(table.SentStates().size(), 3u);
  expect_rising(table.SentStates());
}

}  // namespace
}  // namespace collision::client
