// Goal:   two agents whose collision filters keep them apart never meet.
// Method: two balls that meet head-on within a second.
#include "collision_core/broad_phase/agent_bound.h"

#include <gtest/gtest.h>

namespace collision::broad_phase {
namespace {

TEST(AgentBound, MeetsOnlyThroughGroupsThatBothMasksName) {
  AgentBound a, b;
  for (AgentBound* agent : {&a, &b}) agent->bound.limits.radius = 1;
  a.bound.state.v_WA = {10, 0, 0};
  b.bound.state.p_WA = {12, 0, 0};
  const auto seconds = [&] { return EarliestIntersection(a, b, Instant()).seconds; };
  EXPECT_LE(seconds(), 1.0);
  EXPECT_GE(seconds(), 1.0 - 1e-9);
  b.filter.mask = 2;
  EXPECT_EQ(seconds(), numeric::kInfinity);
  EXPECT_EQ(EarliestIntersection(b, a, Instant()).seconds, numeric::kInfinity);
  a.filter.group = 2;
  EXPECT_LE(seconds(), 1.0);
  b.filter.group = 0;
  EXPECT_EQ(seconds(), numeric::kInfinity);
}

}  // namespace
}  // namespace collision::broad_phase
