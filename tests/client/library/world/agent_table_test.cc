// Goal:   a jump that is staged reaches the service, also if a later state replaces it.
#include "client/library/world/agent_table.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace collision::client
