// Goal:   what is staged of an agent is told whole.
#include "client/fleet.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

// A jump that a later state replaces before the clock comes to it has happened all the same.
TEST(Fleet, OfSeveralStagedStatesOneThatJumpsIsTold) {
  Fleet fleet("simulator", 1, 1, {});
  const AgentId ball = fleet.Add({.name = "ball"}, {.stamp_ns = 0});
  EXPECT_FALSE(fleet.Tell(0).at(0).states(0).discontinuity());
  fleet.Stage(ball, {.stamp_ns = 1, .discontinuity = true});
  fleet.Stage(ball, {.stamp_ns = 2, .position_m = {51, 0, 0}});
  EXPECT_TRUE(fleet.Tell(1).empty());
  const v1::AgentState told = fleet.Tell(2).at(0).states(0);
  EXPECT_EQ(told.position_m().x(), 51);
  EXPECT_TRUE(told.discontinuity());
}

}  // namespace
}  // namespace collision::client
