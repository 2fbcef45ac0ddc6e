#include "collision_core/numeric/first_approach.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/rounding.h"

namespace collision::numeric {
namespace {

MovingBall Make(IntervalVector d0, IntervalVector w, Interval s0, Interval s1, Interval s2) {
  return {d0, {0, 0, 0}, w, 0, {s0, s1, s2}};
}

// Goal:   simple approaches are met within 1e-14, and a limit cuts.
// Method: known by hand: head on; along a 3-4-5 triangle; from growth alone.
TEST(FirstApproach, KnownByHand) {
  const auto head_on = Make({12, 0, 0}, {-10, 0, 0}, 2, 0, 0);
  EXPECT_LE(FirstApproach(head_on, kInfinity), 1.0);
  EXPECT_GE(FirstApproach(head_on, kInfinity), 1 - 1e-14);
  EXPECT_EQ(FirstApproach(head_on, 0.5), kInfinity);
  const auto triangle = Make({6, 4, 0}, {-1, 0, 0}, 5, 0, 0);
  EXPECT_LE(FirstApproach(triangle, 100), 3.0);
  EXPECT_GE(FirstApproach(triangle, 100), 3 - 1e-13);
  const auto growth = Make({0, 0, 18}, {0, 0, 0}, 0, 0, 2);
  EXPECT_LE(FirstApproach(growth, 100), 3.0);
  EXPECT_GE(FirstApproach(growth, 100), 3 - 1e-13);
}

// Goal:   a reach that shrinks (a bound that runs backward) is followed: inside, leave, return.
// Method: d = 10 at rest, S = 8 − 8 δ + 2.5 δ²: reaches 10 at δ = 3.4345; started at S = 12: at
// once.
TEST(FirstApproach, ShrinkingReach) {
  const double root = FirstApproach(Make({10, 0, 0}, {0, 0, 0}, 8, -8, 2.5), kInfinity);
  const double exact = (8 + std::sqrt(64 + 20.0)) / 5;
  EXPECT_LE(root, exact + 1e-15);
  EXPECT_GE(root, exact * (1 - 1e-13));
  EXPECT_EQ(FirstApproach(Make({10, 0, 0}, {0, 0, 0}, 12, -8, 2.5), kInfinity), 0);
}

// Goal:   extremes are defined: nothing moves, no size, infinite or huge coefficients, intervals
// that reach.
TEST(FirstApproach, Extremes) {
  EXPECT_EQ(FirstApproach(Make({1, 0, 0}, {0, 0, 0}, 0, 0, 0), kInfinity), kInfinity);
  EXPECT_EQ(FirstApproach(Make({0, 0, 0}, {0, 0, 0}, 0, 0, 0), kInfinity), 0);
  EXPECT_EQ(FirstApproach(Make({0, 0, 0}, {1, 0, 0}, 0, 0, 0), kInfinity), 0);
  EXPECT_EQ(FirstApproach(Make({1, 0, 0}, {0, 0, 0}, 1, 0, 0), kInfinity), 0);
  EXPECT_EQ(FirstApproach(Make({1, 0, 0}, {0, 0, 0}, 0, 0, 0), 0), kInfinity);
  EXPECT_EQ(FirstApproach(Make({kInfinity, 0, 0}, {0, 0, 0}, 1, 0, 0), kInfinity), 0);
  EXPECT_EQ(FirstApproach(Make({1, 0, 0}, {0, 0, 0}, kInfinity, 0, 0), kInfinity), 0);
  EXPECT_EQ(FirstApproach(Make({Interval(-1, 3), 0, 0}, {0, 0, 0}, 0.5, 0, 0), 1), 0);
  EXPECT_NEAR(FirstApproach(Make({1e18, 0, 0}, {0, 0, 0}, 0, 0, 1e18), kInfinity), 1, 1e-13);
  EXPECT_NEAR(FirstApproach(Make({1e300, 0, 0}, {-1e300, 0, 0}, 0, 0, 0), kInfinity), 1, 1e-13);
  EXPECT_NEAR(FirstApproach(Make({1e-300, 0, 0}, {-1e-300, 0, 0}, 0, 0, 0), kInfinity), 1, 1e-13);
  EXPECT_GE(FirstApproach(Make({1e10, 0, 0}, {-1e-300, 0, 0}, 0, 0, 0), kInfinity), 1e307);
}

// Goal:   two that only draw level at infinity end soon, early at most by what rounding forces.
// Method: |d| = √(1 + δ²) against S = δ: the gap 1/(2δ) falls below rounding, 1e-16 δ, beyond δ =
// 1e7.
TEST(FirstApproach, AsymptoticApproachEnds) {
  EXPECT_GE(FirstApproach(Make({0, 1, 0}, {1, 0, 0}, 0, 1, 0), kInfinity), 1e7);
}

}  // namespace
}  // namespace collision::numeric
