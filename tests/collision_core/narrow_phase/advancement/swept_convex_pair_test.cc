// Goal:   the time for which two moving convex sets stay apart is never late, and exact where all
//         motion is along the direction between them.
// Method: boxes that meet face on, a rod that turns along its tangents, uncertainty that grows;
//         random pairs of balls beside the root of a quadratic.
#include "collision_core/narrow_phase/advancement/swept_convex_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/random.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

constexpr double kDuration = 16;

geometry::ConvexSet Box(const Vector3d& centre, const Vector3d& half) {
  geometry::ConvexSet set;
  set.core = geometry::ConvexCore::kBox;
  set.generators = half.asDiagonal();
  set.centre = centre;
  set.span = half.sum();
  return set;
}

geometry::ConvexSet Rod(const Vector3d& centre, const Vector3d& half) {
  geometry::ConvexSet set;
  set.core = geometry::ConvexCore::kSegment;
  set.generators.col(0) = half;
  set.centre = centre;
  set.span = half.norm();
  return set;
}

MovingSet Moving(const geometry::ConvexSet& set, const Vector3d& velocity) {
  return {set, {.velocity = velocity}};
}

double Apart(const MovingSet& a, const MovingSet& b, double h = 0,
             const SweptPose::Growth& used = {}, double duration = kDuration) {
  WorkBudget work(1'000'000);
  const double apart = ApartFor({a, b, used}, h, duration, &work);
  EXPECT_GT(work.spent(), 0u);
  return apart;
}

/// Two cubes of side 2, 8 m apart, that close at 4 m/s.
const MovingSet kLeft = Moving(Box({0, 0, 0}, {1, 1, 1}), {1, 0, 0});
const MovingSet kRight = Moving(Box({10, 0.5, 0.25}, {1, 1, 1}), {-3, 0, 0});

void ExpectJustBefore(double time, double exact) {
  EXPECT_LE(time, exact);
  EXPECT_GE(time, exact * (1 - 1e-9));
}

TEST(SweptConvexPair, FacesThatMeetAreExact) {
  ExpectJustBefore(Apart(kLeft, kRight), 2);
  ExpectJustBefore(Apart(kRight, kLeft), 2);
}

TEST(SweptConvexPair, CountsFromTheInstantAskedFor) {
  ExpectJustBefore(Apart(kLeft, kRight, 1.5), 0.5);
  EXPECT_EQ(Apart(kLeft, kRight, 2.25), 0) << "they overlap there";
}

TEST(SweptConvexPair, ThoseThatStayApartUpToTheEndDoSoThroughout) {
  EXPECT_EQ(Apart(kLeft, kRight, 0, {}, 1.999), numeric::kInfinity);
  ExpectJustBefore(Apart(kLeft, kRight, 0, {}, 2.001), 2);
  const MovingSet parting = Moving(kRight.set, {3, 0, 0});
  EXPECT_EQ(Apart(kLeft, parting), numeric::kInfinity);
}

TEST(SweptConvexPair, WhatIsUsedUpEndsTheGapEarlier) {
  const MovingSet still = Moving(kLeft.set, {0, 0, 0}), slow = Moving(kRight.set, {-2, 0, 0});
  ExpectJustBefore(Apart(still, slow), 4);
  ExpectJustBefore(Apart(still, slow, 0, {2, 0, 0}), 3);
  ExpectJustBefore(Apart(still, slow, 0, {0, 2, 0}), 2);
  ExpectJustBefore(Apart(still, slow, 0, {0, 0, 1}), 2);
  EXPECT_EQ(Apart(still, slow, 0, {8, 0, 0}), 0);
}

TEST(SweptConvexPair, RoundingRadiiAndErrorsCountAsPartOfTheSets) {
  MovingSet round = kLeft;
  round.set.rounding = 4;
  ExpectJustBefore(Apart(round, kRight), 1);
  MovingSet doubtful = kLeft;
  doubtful.set.error = 4;
  const double apart = Apart(doubtful, kRight);
  EXPECT_LE(apart, 1);
  EXPECT_GE(apart, 0.99) << "the direction is not exact then";
}

// The rod of half-length 2 turns about its middle; its tip comes along its tangent, at 2 m/s,
// towards a wall 6 m away.
TEST(SweptConvexPair, ATurningRodMeetsAWallWhenItsTipsTangentDoes) {
  const MovingSet rod{Rod({0, 0, 0}, {0, 2, 0}), {.spin = {0, 0, 1}}};
  const MovingSet wall = Moving(Box({-7, 0, 0}, {1, 9, 9}), {0, 0, 0});
  ExpectJustBefore(Apart(rod, wall), 3);
  ExpectJustBefore(Apart(wall, rod), 3);
  MovingSet about_its_end = rod;
  about_its_end.motion.about = {0, -2, 0};  // the tip is 4 m from there
  ExpectJustBefore(Apart(about_its_end, wall), 1.5);
}

// Goal:   the direction is that of one instant, so the answer may be early, but never late.
TEST(SweptConvexPair, RandomBallsNeverTouchEarlierThanTheAnswer) {
  Random random(31);
  int tight = 0, throughout = 0;
  constexpr int kPairs = 3000;
  for (int pair = 0; pair < kPairs; ++pair) {
    const double size = random.LogUniform(1e-3, 1e3);
    const Vector3d d = random.UnitVector() * size * random.Uniform(3, 10);
    const Vector3d w = random.UnitVector() * size * random.LogUniform(0.1, 10);
    const double radius = size * random.Uniform(0.1, 1.4), other = size * 0.1;
    const double apart = Apart(Moving(geometry::BallSet({0, 0, 0}, radius), {0, 0, 0}),
                               Moving(geometry::BallSet(d, other), w));
    const double sum = radius + other, ww = w.squaredNorm(), dw = d.dot(w);
    const double square = dw * dw - ww * (d.squaredNorm() - sum * sum);
    const bool meet = dw < 0 && square >= 0;
    const double truth = meet ? (-dw - std::sqrt(square)) / ww : numeric::kInfinity;
    if (truth <= kDuration * (1 - 1e-9)) {
      ASSERT_LE(apart, truth * (1 + 1e-9)) << pair;
    }
    // Along the first direction the gap closes at this speed.
    const double along = (d.norm() - sum) / std::max(1e-300, -dw / d.norm());
    if (dw < 0 && along < kDuration) {
      ASSERT_GE(apart, along * (1 - 1e-3)) << pair;
      ++tight;
    } else if (dw >= 0) {
      ASSERT_EQ(apart, numeric::kInfinity);
      ++throughout;
    }
  }
  EXPECT_GT(tight, 500);
  EXPECT_GT(throughout, 500);
}

}  // namespace
}  // namespace collision::narrow_phase
