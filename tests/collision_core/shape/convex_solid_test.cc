#include "collision_core/shape/convex_solid.h"

#include <gtest/gtest.h>

#include "collision_core/geometry/convex/epa.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_convex.h"

namespace collision::shape {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

ConvexDescription Described(geometry::ConvexCore core, const Vector3d& half, double rounding) {
  ConvexDescription d;
  d.core = core;
  d.half = half;
  d.rounding = rounding;
  return d;
}

ConvexDescription RandomSolid(Random& random, double size) {
  ConvexDescription d;
  const geometry::ConvexCore cores[] = {geometry::ConvexCore::kPoint,
                                        geometry::ConvexCore::kSegment, geometry::ConvexCore::kBox,
                                        geometry::ConvexCore::kHull};
  d.core = cores[random.Below(4)];
  for (int axis = 0; axis < 3; ++axis) d.half[axis] = size * random.Uniform(0.1, 1);
  for (auto i = 4 + random.Below(8); d.core == geometry::ConvexCore::kHull && i > 0; --i) {
    d.points.push_back(size * random.Uniform(0.5, 1) * random.UnitVector());
  }
  if (d.core == geometry::ConvexCore::kPoint || random.Chance(0.3)) d.rounding = 0.3 * size;
  d.q_BS = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1), 0.1};
  d.p_BS = random.LogUniform(1e-3, 1e3) * size * random.UnitVector();
  return d;
}

// Goal:   the balls and the box contain the solid, and are not much larger than needed.
// Method: exact corners; sizes from 1e-4 to 1e3 m.
TEST(ConvexSolid, BoundsContainIt) {
  Random random(341);
  for (int i = 0; i < 400; ++i) {
    const double size = random.LogUniform(1e-4, 1e3);
    const ConvexDescription d = RandomSolid(random, size);
    ASSERT_FALSE(RefusalOf(d)) << *RefusalOf(d);
    const ConvexFacts facts = ConvexSolid::Build(d).facts();
    const Exact rounding = d.rounding;
    double furthest = 0;
    for (const ExactVector& x : ExactCorners(d)) {
      EXPECT_TRUE(IsAtLeast(facts.radius, Square(x), -rounding));
      EXPECT_TRUE(
          IsAtLeast(facts.ball_radius, Square(x - ExactVector(facts.ball_centre)), -rounding));
      const Exact coordinates[] = {x.x, x.y, x.z};
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(Exact(facts.lower[axis]), coordinates[axis] - rounding);
        EXPECT_GE(Exact(facts.upper[axis]), coordinates[axis] + rounding);
      }
      furthest = std::max(furthest, std::sqrt(static_cast<double>(Square(x))));
    }
    EXPECT_LE(facts.radius, (furthest + d.rounding) * (1 + 1e-12));
    EXPECT_LE((facts.upper - facts.lower).norm(), 8 * size);
    EXPECT_LE(facts.ball_radius, 2.2 * size);
  }
}

// Goal:   the ball inside is inside, and not much smaller than the largest one.
// Method: boxes and balls have closed answers; of hulls the faces through any three corners decide,
//         in rational arithmetic.
TEST(ConvexSolid, BallInside) {
  Random random(342);
  for (int i = 0; i < 100; ++i) {
    const ConvexDescription d = RandomSolid(random, 1);
    const ConvexFacts facts = ConvexSolid::Build(d).facts();
    if (d.core == geometry::ConvexCore::kPoint || d.core == geometry::ConvexCore::kSegment) {
      EXPECT_NEAR(facts.inradius, d.rounding, 1e-12 * (1 + d.p_BS.norm()));
      EXPECT_LE(facts.inradius, d.rounding);
    }
    if (d.core == geometry::ConvexCore::kBox) {
      EXPECT_NEAR(facts.inradius, d.half.minCoeff() + d.rounding, 1e-12 * (1 + d.p_BS.norm()));
    }
    if (d.core != geometry::ConvexCore::kHull) continue;
    const ExactPoints corners = ExactCorners(d), centre = {ExactVector(facts.inner_point)};
    const Exact square = SquareOfDepth(centre, corners, FaceDirections({centre[0]}, corners));
    EXPECT_TRUE(IsAtMost(facts.inradius, square, -Exact(d.rounding))) << facts.inradius;
    EXPECT_EQ(Square(NearestToZero(Difference(centre, corners))), 0);
    EXPECT_GT(facts.inradius, 0.02);
  }
}

// Goal:   of a cube given as a hull the ball inside is nearly the largest one.
TEST(ConvexSolid, BallInsideOfACube) {
  ConvexDescription d;
  d.core = geometry::ConvexCore::kHull;
  for (int i = 0; i < 8; ++i) {
    d.points.push_back({i & 1 ? 5.0 : 3.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  }
  const ConvexFacts facts = ConvexSolid::Build(d).facts();
  EXPECT_GT(facts.inradius, 0.95);
  EXPECT_LE(facts.inradius, 1);
}

// Goal:   points that have no volume, doubled points and a single one are taken; nothing is inside.
TEST(ConvexSolid, DirtyHulls) {
  const std::vector<std::vector<Vector3d>> hulls = {
      {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}},
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0.5, 0, 0}},
      {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.5, 0.5, 1}},
  };
  for (const auto& points : hulls) {
    ConvexDescription d;
    d.core = geometry::ConvexCore::kHull;
    d.points = points;
    ASSERT_FALSE(RefusalOf(d));
    EXPECT_EQ(ConvexSolid::Build(d).facts().inradius, 0);
    d.rounding = 0.5;
    EXPECT_NEAR(ConvexSolid::Build(d).facts().inradius, 0.5, 1e-15);
  }
  ConvexDescription point;
  point.core = geometry::ConvexCore::kHull;
  point.points = {{1, 2, 3}};
  EXPECT_TRUE(RefusalOf(point));  // No size at all.
  point.rounding = 1;
  EXPECT_FALSE(RefusalOf(point));
  EXPECT_NEAR(ConvexSolid::Build(point).facts().inradius, 1, 1e-15);
}

// Goal:   what cannot be a solid is refused by field, value and allowed range.
TEST(ConvexSolid, Refusals) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const ConvexDescription& d, const std::string& text) {
    const auto refusal = RefusalOf(d);
    ASSERT_TRUE(refusal) << text;
    EXPECT_NE(refusal->find(text), std::string::npos) << *refusal;
  };
  const ConvexDescription box = Described(geometry::ConvexCore::kBox, {1, 1, 1}, 0);
  EXPECT_FALSE(RefusalOf(box));
  for (const double bad : {nan, -1e-9, 1.1e7, static_cast<double>(HUGE_VAL)}) {
    refused(Described(geometry::ConvexCore::kBox, {1, bad, 1}, 0), "convex.half.y");
    refused(Described(geometry::ConvexCore::kBox, {1, 1, 1}, bad), "convex.rounding");
    refused(Described(geometry::ConvexCore::kSegment, {0, 0, bad}, 0), "convex.half.z");
    EXPECT_FALSE(RefusalOf(Described(geometry::ConvexCore::kSegment, {bad, bad, 1}, 0)));
  }
  refused(Described(geometry::ConvexCore::kPoint, {0, 0, 0}, 0),
          "its size is 0 m; allowed are 1e-06 to 1e+07");
  refused(Described(geometry::ConvexCore::kBox, {1e-7, 1e-7, 1e-7}, 0), "allowed are 1e-06");
  refused(Described(geometry::ConvexCore::kTriangle, {1, 1, 1}, 0), "convex.core");
  refused(Described(geometry::ConvexCore::kHull, {1, 1, 1}, 0), "convex.points: there are 0");
  ConvexDescription d = box;
  d.p_BS = {0, 0, nan};
  refused(d, "convex.p_BS.z");
  d.p_BS = {0, 0, -2e7};
  refused(d, "convex.p_BS.z is -2e+07; allowed are finite values within ±1e+07");
  d = box;
  d.q_BS = Quaterniond(0, 0, 0, 0);
  refused(d, "convex.q_BS has the length 0");
  d.q_BS = Quaterniond(1, 0, nan, 0);
  refused(d, "convex.q_BS");
  d = box;
  d.core = geometry::ConvexCore::kHull;
  d.points = {{0, 0, 0}, {1, nan, 0}};
  refused(d, "convex.points[1].y");
  d.points.assign(kHullPointsMax + 1, {1, 1, 1});
  refused(d, "convex.points: there are 65537; allowed are 1 to 65536");
}

}  // namespace
}  // namespace collision::shape
