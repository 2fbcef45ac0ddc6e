// Goal:   between two states the history gives only what holds for every motion between them.
// Method: two states a second apart, joined, jumped, broken, expired, redeclared; the bounds by
//         hand.
#include "collision_core/detection/agents/history.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

motion::SpaceTimeBound Bound(double t, double acceleration_max = 2, double radius = 1) {
  motion::SpaceTimeBound bound;
  bound.state = State(t, {0, 0, 0}, {0, 0, 0});
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

History Of(const motion::SpaceTimeBound& first, const motion::SpaceTimeBound& second, Link link) {
  History history;
  history.Push({.bound = first, .link = Link::kJumped}, 8);
  history.Push({.bound = second, .link = link}, 8);
  return history;
}

TEST(History, BothDirectionsHoldBetweenStatesThatFollow) {
  const narrow_phase::BodySegment segment =
      Of(Bound(0), Bound(1), Link::kFollows).Over(At(0), At(1));
  ASSERT_EQ(segment.ball.bounds.size(), 2u);
  EXPECT_EQ(segment.ball.bounds[0].u.At(1).upper, 1);  // ½ 2 1²
  EXPECT_EQ(segment.ball.bounds[1].u.At(0).upper, 1);
}

TEST(History, NoBoundRunsBackwardOverAJump) {
  const History history = Of(Bound(0), Bound(1), Link::kJumped);
  EXPECT_EQ(history.Over(At(0), At(1)).ball.bounds.size(), 1u);
}

TEST(History, NothingIsKnownWhereABoundWasBroken) {
  const History history = Of(Bound(0), Bound(1), Link::kBroken);
  EXPECT_TRUE(history.Over(At(0), At(1)).ball.bounds.empty());
  EXPECT_EQ(history.Over(At(0), At(0)).ball.bounds.size(), 1u);
  EXPECT_EQ(history.Over(At(1), At(2)).ball.bounds.size(), 1u);
}

TEST(History, NothingIsKnownBeyondAnExpiry) {
  motion::SpaceTimeBound bound = Bound(0);
  bound.state.expiry = At(1);
  History history;
  history.Push({.bound = bound, .link = Link::kJumped}, 8);
  EXPECT_EQ(history.NextCutAfter(At(0)), At(1));
  EXPECT_EQ(history.Over(At(0), At(1)).ball.bounds.size(), 1u);
  EXPECT_TRUE(history.Over(At(1), At(2)).ball.bounds.empty());
}

// Either declaration may have been in force in between.
TEST(History, BetweenTwoDeclarationsTheWiderCounts) {
  for (const auto& [first, second] : {std::pair(2.0, 4.0), std::pair(4.0, 2.0)}) {
    const History history = Of(Bound(0, first), Bound(1, second), Link::kFollows);
    const narrow_phase::BodySegment segment = history.Over(At(0), At(1));
    ASSERT_EQ(segment.ball.bounds.size(), 2u);
    for (const numeric::MovingBall& ball : segment.ball.bounds)
      EXPECT_EQ(ball.u.c2.upper, 2);  // ½ 4
  }
  const narrow_phase::BodySegment of_radii =
      Of(Bound(0, 2, 1), Bound(1, 2, 3), Link::kFollows).Over(At(0), At(1));
  EXPECT_EQ(of_radii.ball.radius, 1);
  EXPECT_EQ(of_radii.ball.bounds[0].u.At(0).upper, 2);
}

TEST(History, AMotionIsUninterruptedUpToAJumpOrABreach) {
  for (const Link link : {Link::kJumped, Link::kBroken}) {
    const History history = Of(Bound(0), Bound(1), link);
    EXPECT_EQ(history.Uninterrupted(At(0.5)), nullptr);
    EXPECT_NE(history.Uninterrupted(At(1)), nullptr);
  }
  EXPECT_NE(Of(Bound(0), Bound(1), Link::kFollows).Uninterrupted(At(0.5)), nullptr);
}

// A clock may be off by 0.1 s: about the jump one ball holds where it was and where it is.
TEST(History, AboutAJumpOneBallHoldsBothMotions) {
  motion::SpaceTimeBound first = Bound(0, 0), second = Bound(1, 0);
  first.skew = second.skew = 0.125;
  second.state.p_WA = {3, 4, 0};
  const History history = Of(first, second, Link::kJumped);
  const narrow_phase::BodySegment segment = history.Over(At(0.875), At(1));
  ASSERT_EQ(segment.ball.bounds.size(), 1u);
  EXPECT_GE(segment.ball.bounds[0].u.At(0).lower, 5);
}

}  // namespace
}  // namespace collision::detection
