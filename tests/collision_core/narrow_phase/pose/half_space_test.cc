// Goal:   the block that stands in for a half-space leaves the signed distance of a body to it
//         certified, and nearly as narrow as if the half-space were finite: near and far from the
//         origin, for any normal, above the plane, across it and deep below.
// Method: hulls of random points whose orientation is exact, so that the nearest vertex decides;
//         exact arithmetic, with the normal's length to 100 digits.
#include <gtest/gtest.h>

#include <boost/multiprecision/gmp.hpp>
#include <set>

#include "collision_core/narrow_phase/contact/shape_contact.h"
#include "collision_core/narrow_phase/pose/segment_pose.h"
#include "collision_core/narrow_phase/separation/separation.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;
using Digits = boost::multiprecision::mpf_float_100;

struct Case {
  Vector3d normal;
  double offset;
  Vector3d position;
  std::vector<Vector3d> points;
  double rounding;
};

/// The signed distance of the body to the half-space.
Digits TruthOf(const Case& c) {
  Digits least = 0, square = 0;
  for (const Vector3d& point : c.points) {
    Exact height = -Exact(c.offset);
    for (int k = 0; k < 3; ++k) {
      height += Exact(c.normal[k]) * (Exact(c.position[k]) + Exact(point[k]));
    }
    const Digits found(height);
    if (&point == c.points.data() || found < least) least = found;
  }
  for (int k = 0; k < 3; ++k) square += Digits(c.normal[k]) * Digits(c.normal[k]);
  return least / sqrt(square) - Digits(c.rounding);
}

BodySegment Body(const Case& c) {
  shape::ConvexDescription hull;
  hull.core = geometry::ConvexCore::kHull;
  hull.points = c.points;
  hull.rounding = c.rounding;
  BodySegment body;
  body.shape = shape::Shape::Compound(nullptr, {shape::ConvexSolid::Build(hull)});
  motion::SpaceTimeBound bound;
  bound.state.p_WA = c.position;
  bound.limits.radius = body.ball.radius = body.shape->facts().radius;
  bound.limits.angular_acceleration_max = 0;
  body.ball.bounds.push_back(ForwardBall(bound, Instant()));
  body.turns.push_back(ForwardRotation(bound, Instant()));
  return body;
}

BodySegment HalfSpaceOf(const Case& c) {
  BodySegment half_space;
  half_space.half_space = shape::FixedHalfSpace::Build(c.normal, c.offset)->WithBlocks();
  half_space.ball.bounds.push_back(ForwardBall(motion::SpaceTimeBound{}, Instant()));
  return half_space;
}

Case Draw(Random* random) {
  Case c;
  c.normal = random->UnitVector();
  if (random->Below(4) == 0) c.normal = Vector3d::Unit(static_cast<Eigen::Index>(random->Below(3)));
  const double size = random->LogUniform(1e-2, 1e6), far = random->LogUniform(1, 1e9);
  for (int i = 0; i < 6; ++i) c.points.push_back(size * random->UnitVector());
  c.rounding = random->Below(2) == 0 ? 0 : 0.25 * size;
  c.position = far * random->UnitVector();
  c.offset = c.normal.dot(c.position) + size * random->Uniform(-20, 20);
  return c;
}

/// The distance, as narrow as it can be had.
numeric::Interval Narrowed(const BodyPair& bodies) {
  const BodyTree a(bodies.a), b(bodies.b);
  const RelativePose pose = PoseAt(bodies.a, bodies.b, BestBounds(bodies.a, bodies.b, 0), 0);
  WorkBudget work(1'000'000);
  const auto found = BracketSeparation({a, b, pose}, {}, &work);
  return {found.lower, found.upper};
}

TEST(HalfSpaceStandIn, TheSignedDistanceOfABodyIsCertified) {
  Random random(1);
  int apart = 0, touching = 0, below = 0;
  for (int i = 0; i < 3000; ++i) {
    const Case c = Draw(&random);
    BodyPair bodies{Body(c), HalfSpaceOf(c)};
    if (i % 2 == 0) std::swap(bodies.a, bodies.b);
    ReplaceHalfSpace(0, &bodies);
    WorkBudget work(1'000'000);
    const Proximity found = ShapeProximity(bodies.a, bodies.b, 0, &work);
    const Digits truth = TruthOf(c);
    ASSERT_GE(truth, Digits(found.separation.lower)) << i;
    ASSERT_LE(truth, Digits(found.separation.upper)) << i;
    const double size = c.points[0].norm();
    const double lost = 1e-13 * c.position.norm() + 1e-9 * size;
    const double above = static_cast<double>(truth);
    if (above > lost) {
      ++apart;
      const numeric::Interval close = Narrowed(bodies);
      EXPECT_GE(close.lower, above - lost - 1e-6 * above) << i;
      EXPECT_LE(close.upper, above + lost + 1e-6 * above) << i;
    } else if (above < -lost) {
      ++touching;
      below += above < -4 * size;
      EXPECT_LE(found.separation.upper, 0) << i;
    }
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(touching, 1000);
  EXPECT_GT(below, 300);
}

TEST(HalfSpaceStandIn, OfABodyThatMayBeAnywhereNothingIsClaimed) {
  Random random(2);
  Case c = Draw(&random);
  BodyPair bodies{Body(c), HalfSpaceOf(c)};
  bodies.a.ball.bounds[0].u.c0 = numeric::Interval(1e30);
  ReplaceHalfSpace(0, &bodies);
  EXPECT_TRUE(bodies.b.awaited);
  EXPECT_TRUE(bodies.b.ball.bounds.empty());
}

TEST(HalfSpaceStandIn, TheBlockLooksEndlessForAsLongAsTheBodyMoves) {
  Case c{{0, 0, 1}, 0, {0, 0, 1e4}, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}}, 0};
  BodyPair bodies{Body(c), HalfSpaceOf(c)};
  bodies.a.ball.bounds[0].velocity = numeric::IntervalVector(Vector3d(7000, 0, -1e3));
  ReplaceHalfSpace(100, &bodies);
  WorkBudget work(1'000'000);
  const Proximity found = ShapeProximity(bodies.a, bodies.b, 9.0, &work);
  EXPECT_LE(found.separation.lower, 1e3 - 1);
  EXPECT_GE(found.separation.upper, 1e3 - 1);
  EXPECT_GE(found.separation.lower, 500);
  EXPECT_GE(bodies.b.shape->facts().radius, 4 * 7e5);
}

TEST(HalfSpaceStandIn, TheTreesOfAllBlocksAreWellFormed) {
  const auto floor = shape::FixedHalfSpace::Build({0, 0, 1}, 0)->WithBlocks();
  std::set<double> radii;
  double reach = 1e-5;
  while (const auto block = floor->Around(Vector3d::Zero(), reach)) {
    EXPECT_EQ(RefusalOf(block->shape->tree(), {.solids = 1}), std::nullopt) << reach;
    radii.insert(block->shape->facts().radius);
    reach *= 2;
  }
  EXPECT_EQ(radii.size(), 14u);
  EXPECT_GT(*radii.rbegin(), 1e8);
}

TEST(HalfSpaceStandIn, GrownItsPlaneLiesHigherByThatMuchAtLeast) {
  const Vector3d normal = Vector3d(1, 2, 3).normalized();
  const auto grown = shape::FixedHalfSpace::Build(normal, 5)->WithBlocks()->Grown(0.5);
  EXPECT_GE(grown->offset(), 5.5 * (1 - 1e-15));
  EXPECT_LE(grown->offset(), 5.5 * (1 + 1e-15));
}

TEST(HalfSpaceStandIn, WhatIsNoHalfSpaceIsRefusedWithFieldAndRange) {
  EXPECT_FALSE(shape::RefusalOfHalfSpace({0, 0, 1}, -1e15));
  EXPECT_EQ(*shape::RefusalOfHalfSpace({0, 0, 2}, 0),
            "half_space.normal has the length 2; allowed is 1, to within 1e-06");
  EXPECT_EQ(*shape::RefusalOfHalfSpace({0, 0, 1}, 2e15),
            "half_space.offset_m is 2e+15; allowed are -1e+15 to 1e+15");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(shape::RefusalOfHalfSpace({0, nan, 1}, 0));
  EXPECT_TRUE(shape::RefusalOfHalfSpace({0, 0, 1}, nan));
}

}  // namespace
}  // namespace collision::narrow_phase
