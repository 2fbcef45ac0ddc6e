#include "collision_core/detection/agents/bound_margin.h"

#include <gtest/gtest.h>

namespace collision::detection {
namespace {

motion::SpaceTimeBound Moving() {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = {3000, 4000, 0};
  bound.state.v_WA = {0, 60, 80};
  bound.limits.radius = 10;
  bound.limits.acceleration_max = 5;
  return bound;
}

motion::ContractCheck Drift(double position, double velocity) {
  motion::ContractCheck check;
  check.position_drift = position;
  check.velocity_drift = velocity;
  return check;
}

// Goal:   the full margin is what the header says, and what kept states may have lost is taken off
//         it, until there is not enough left. Method: |p| = 5000, |v| = 100; three parts of 0.4.
TEST(BoundMargin, IsSpentByDrifts) {
  const motion::SpaceTimeBound bound = Moving();
  const BoundMargin full(bound);
  const double position = full.Widen(bound).state.position_error;
  const double velocity = full.Widen(bound).state.velocity_error;
  EXPECT_NEAR(position, 5110 * 0x1p-40 + 4e-9 * 100, 1e-12 * position);
  EXPECT_NEAR(velocity, 100 * 0x1p-40 + 4e-9 * 5, 1e-12 * velocity);
  for (const bool of_position : {true, false}) {
    const motion::ContractCheck drift =
        of_position ? Drift(0.4 * position, 0) : Drift(0, 0.4 * velocity);
    BoundMargin margin = full;
    EXPECT_TRUE(margin.Spend(drift, bound));
    EXPECT_TRUE(margin.Spend(drift, bound));
    const motion::MotionState left = margin.Widen(bound).state;
    EXPECT_NEAR(left.position_error, (of_position ? 0.2 : 1) * position, 1e-9 * position);
    EXPECT_NEAR(left.velocity_error, (of_position ? 1 : 0.2) * velocity, 1e-9 * velocity);
    EXPECT_FALSE(margin.Spend(drift, bound)) << of_position;
  }
}

// Goal:   each widened bound lies inside the one before, also where the sum of error and margin is
//         rounded. Method: errors far above the margin; the sum of error, margin and drift.
TEST(BoundMargin, WidenedBoundsAreNested) {
  motion::SpaceTimeBound bound = Moving();
  bound.state.position_error = 0.3;
  BoundMargin margin(bound);
  double before = margin.Widen(bound).state.position_error;
  for (int i = 0; i < 100; ++i) {
    const double drift = 1e-12 * i;
    if (!margin.Spend(Drift(drift, 0), bound)) break;
    const double after = margin.Widen(bound).state.position_error;
    EXPECT_LE(after + drift, before) << i;
    before = after;
  }
}

// Goal:   after a jump the bound holds where the agent may have been since the skew before it.
TEST(BoundMargin, AJumpMayHaveComeEarlier) {
  motion::SpaceTimeBound bound = Moving();
  bound.skew = 0.01;
  const BoundMargin margin(bound);
  const double without = margin.Widen(bound).state.position_error;
  bound.state.discontinuity = true;
  EXPECT_GE(margin.Widen(bound).state.position_error, without + 2 * 100 * 0.01);
}

// Goal:   a known acceleration has a margin of its own, which drift takes off and which a widened
//         bound counts as unknown; an agent that knows none has none.
TEST(BoundMargin, KnownAccelerationsHaveTheirOwn) {
  motion::SpaceTimeBound bound = Moving();
  EXPECT_EQ(BoundMargin(bound).Widen(bound).limits.acceleration_max, bound.limits.acceleration_max);
  bound.state.a_WA = {0, 6, 8};
  bound.limits.acceleration_max = 0;
  bound.limits.jerk_max = 3;
  BoundMargin margin(bound);
  const double whole = margin.Widen(bound).limits.acceleration_max;
  EXPECT_NEAR(whole, 10 * 0x1p-40 + 4e-9 * 3, 1e-12 * whole);
  motion::ContractCheck drift;
  drift.acceleration_drift = 0.6 * whole;
  EXPECT_TRUE(margin.Spend(drift, bound));
  EXPECT_NEAR(margin.Widen(bound).limits.acceleration_max, 0.4 * whole, 1e-9 * whole);
  EXPECT_FALSE(margin.Spend(drift, bound));
}

}  // namespace
}  // namespace collision::detection
