// Goal:   a ball contains its points, to the last bit, and is hardly larger than the smallest.
// Method: exact distances; points on a sphere, whose smallest ball is known.
#include "collision_core/geometry/triangle/enclosing_ball.h"

#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "tests/collision_core/geometry/exact_geometry.h"
#include "tests/support/random.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

void ExpectContained(const EnclosingBall& ball, const std::vector<Vector3d>& points) {
  for (const Vector3d& p : points) {
    const ExactPoint d = ExactOf(p) - ExactOf(ball.centre);
    ASSERT_LE(DotOf(d, d), Squared(ball.radius));
  }
}

TEST(EnclosingBall, ContainsEveryPoint) {
  Random random(101);
  for (int i = 0; i < 5000; ++i) {
    const double scale = random.LogUniform(1e-170, 1e7);
    const Vector3d origin =
        random.Chance(0.5) ? Vector3d::Zero() : Vector3d(1e6 * random.UnitVector());
    std::vector<Vector3d> points(1 + random.Below(12));
    for (Vector3d& p : points) p = origin + scale * random.Uniform(0, 1) * random.UnitVector();
    ExpectContained(SmallBallAround(points), points);
  }
}

TEST(EnclosingBall, IsNearlyTheSmallest) {
  Random random(102);
  double sum = 0;
  for (int i = 0; i < 500; ++i) {
    // Pairs of opposite points: no smaller ball than the unit ball contains them.
    std::vector<Vector3d> points;
    for (std::uint64_t k = 1 + random.Below(4); k > 0; --k) {
      points.push_back(random.UnitVector());
      points.push_back(-points.back());
    }
    // And others inside, which pull the middle of the box aside.
    for (std::uint64_t k = random.Below(4); k > 0; --k) points.push_back(0.9 * random.UnitVector());
    const double radius = SmallBallAround(points).radius;
    ASSERT_LT(radius, 1.2);
    sum += radius;
  }
  EXPECT_LT(sum / 500, 1.03);
}

TEST(EnclosingBall, OfNoPointsIsRefused) { EXPECT_THROW(SmallBallAround({}), CheckFailure); }

}  // namespace
}  // namespace collision::geometry
