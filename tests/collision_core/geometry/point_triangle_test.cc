// Goal:   the interval contains the exact distance and is narrow, also for slivers, and a triangle
//         is called farther only if it is.
// Method: exact rational squared distances.
#include "collision_core/geometry/triangle/point_triangle.h"

#include <gtest/gtest.h>

#include "tests/collision_core/geometry/exact_geometry.h"
#include "tests/support/random.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

Vector3d InCube(Random& random) {
  return {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
}

/// Fair triangles, slivers of all kinds and far from the origin.
TrianglePoints AnyTriangle(Random& random) {
  const Vector3d origin = random.Chance(0.3) ? Vector3d(1e5 * InCube(random)) : Vector3d::Zero();
  TrianglePoints t = {InCube(random), InCube(random), InCube(random)};
  const double thin = random.LogUniform(1e-16, 1);
  if (random.Chance(0.3)) t[2] = t[0] + thin * (t[2] - t[0]);
  if (random.Chance(0.3)) t[2] = t[0] + random.Uniform(0, 1) * (t[1] - t[0]) + thin * t[2];
  for (auto& p : t) p += origin;
  return t;
}

/// Near, on, above, beside or far away.
Vector3d AnyPoint(const TrianglePoints& t, Random& random) {
  const Vector3d on =
      t[0] + random.Uniform(-0.3, 1.3) * (t[1] - t[0]) + random.Uniform(-0.3, 1.3) * (t[2] - t[0]);
  switch (random.Below(4)) {
    case 0:
      return t[random.Below(3)];
    case 1:
      return on;
    default:
      return on + random.LogUniform(1e-17, 1e3) * random.UnitVector();
  }
}

double ExtentOf(const TrianglePoints& t, const Vector3d& p) {
  return std::max({(p - t[0]).norm(), (p - t[1]).norm(), (p - t[2]).norm()});
}

ExactTriangle ExactCorners(const TrianglePoints& t) {
  return {ExactOf(t[0]), ExactOf(t[1]), ExactOf(t[2])};
}

TEST(PointTriangle, ContainsTheExactDistanceAndIsNarrow) {
  Random random(41);
  for (int i = 0; i < 20000; ++i) {
    const TrianglePoints t = AnyTriangle(random);
    const Vector3d p = AnyPoint(t, random);
    const Exact exact = SquaredDistance(ExactOf(p), ExactCorners(t));
    const numeric::Interval d = DistanceToTriangle(p, t).distance;
    ASSERT_LE(Squared(d.lower), exact);
    ASSERT_GE(Squared(d.upper), exact);
    ASSERT_GE(d.lower, 0);
    const double allowance = 1e-14 * ExtentOf(t, p) + 0x1p-52 * t[0].cwiseAbs().maxCoeff();
    ASSERT_LE(d.width(), allowance) << i << " at distance " << d.upper;
    ASSERT_NEAR((p - DistanceToTriangle(p, t).nearest).norm(), d.upper,
                1e-9 * (1 + ExtentOf(t, p)));
  }
}

TEST(PointTriangle, KnownDistances) {
  const TrianglePoints t = {Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)};
  EXPECT_EQ(DistanceToTriangle({1, 1, 7}, t).distance.upper, 7);
  EXPECT_EQ(DistanceToTriangle({1, 1, 7}, t).distance.lower, 7);
  EXPECT_EQ(DistanceToTriangle({-2, -3, 6}, t).distance.upper, 7);  // 2² + 3² + 6² = 7²
  EXPECT_EQ(DistanceToTriangle({1, -3, 4}, t).distance.upper, 5);
  EXPECT_EQ(DistanceToTriangle({4, 0, 0}, t).distance.upper, 0);
}

TEST(PointTriangle, WithoutAreaIsItsLongestSide) {
  const TrianglePoints line = {Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(1, 0, 0)};
  EXPECT_TRUE(DistanceToTriangle({2, 3, 4}, line).distance.Contains(5));
  const TrianglePoints point = {Vector3d(1, 2, 3), Vector3d(1, 2, 3), Vector3d(1, 2, 3)};
  EXPECT_TRUE(DistanceToTriangle({3, 5, 9}, point).distance.Contains(7));
}

TEST(PointTriangle, FartherIsNeverWrongAndSeldomUnsure) {
  Random random(42);
  int said = 0, trials = 0;
  for (int i = 0; i < 20000; ++i) {
    const TrianglePoints t = AnyTriangle(random);
    const Vector3d p = AnyPoint(t, random);
    const Exact exact = SquaredDistance(ExactOf(p), ExactCorners(t));
    const double distance = DistanceToTriangle(p, t).distance.upper;
    const double asked =
        distance * (1 + random.LogUniform(1e-17, 1e-3) * (random.Chance(0.5) ? 1 : -1));
    const bool farther = IsCertainlyFarther(p, t, asked);
    if (farther) {
      ASSERT_GT(exact, Squared(asked));
    }
    if (distance < 0.01 * ExtentOf(t, p)) continue;
    ++trials;
    said += IsCertainlyFarther(p, t, 0.999 * distance);
  }
  EXPECT_GT(said, 0.99 * trials);
}

}  // namespace
}  // namespace collision::geometry
