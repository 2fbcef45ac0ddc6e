// Goal:   orientation signs are exact, and unknown only where products leave the doubles.
// Method: rational arithmetic on points drawn onto lines and planes, then moved by single units in
// the last place.
#include "collision_core/numeric/exact_sign.h"

#include <gtest/gtest.h>

#include "tests/collision_core/geometry/exact_geometry.h"
#include "tests/support/random.h"

namespace collision::numeric {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using collision::operator-;  // Of exact points.

/// By units in the last place; not zero, whose neighbours are the smallest of all doubles.
double Nudged(double x, Random& random) {
  if (x == 0) return x;
  for (std::uint64_t i = random.Below(3); i > 0; --i)
    x = random.Chance(0.5) ? NextUp(x) : NextDown(x);
  return x;
}

Vector3d Nudged(const Vector3d& p, Random& random) {
  return {Nudged(p.x(), random), Nudged(p.y(), random), Nudged(p.z(), random)};
}

Vector3d AnyPoint(Random& random) {
  // Few different coordinates, so that exact ties are common.
  if (random.Chance(0.3)) {
    return {0.25 * double(random.Below(5)), 0.25 * double(random.Below(5)),
            0.25 * double(random.Below(5))};
  }
  const double scale = random.LogUniform(1e-3, 1e7);
  return scale * Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
}

TEST(OrientationSign, InThePlaneIsExactNearLines) {
  Random random(31);
  int zeros = 0;
  for (int i = 0; i < 50000; ++i) {
    const Vector3d a = AnyPoint(random), b = AnyPoint(random);
    const Vector3d c = Nudged(Vector3d(a + random.Uniform(-1, 2) * (b - a)), random);
    const ExactPoint n = CrossOf(ExactOf(b) - ExactOf(a), ExactOf(c) - ExactOf(a));
    const auto sign =
        OrientationSign(Vector2d(a.head<2>()), Vector2d(b.head<2>()), Vector2d(c.head<2>()));
    ASSERT_EQ(sign, std::optional(n[2].sign()));
    zeros += n[2].sign() == 0;
    ASSERT_EQ(IsCertainlyCollinear(a, b, c), n[0] == 0 && n[1] == 0 && n[2] == 0);
  }
  EXPECT_GT(zeros, 500);
}

TEST(OrientationSign, InSpaceIsExactNearPlanes) {
  Random random(32);
  int zeros = 0;
  for (int i = 0; i < 30000; ++i) {
    const Vector3d a = AnyPoint(random), b = AnyPoint(random), c = AnyPoint(random);
    const Vector3d p = Nudged(
        Vector3d(a + random.Uniform(-1, 1) * (b - a) + random.Uniform(-1, 1) * (c - a)), random);
    const ExactPoint n = CrossOf(ExactOf(b) - ExactOf(a), ExactOf(c) - ExactOf(a));
    const int expected = DotOf(n, ExactOf(p) - ExactOf(a)).sign();
    ASSERT_EQ(OrientationSign(a, b, c, p), std::optional(expected));
    ASSERT_EQ(OrientationSign(b, a, c, p), std::optional(-expected));
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 100);
}

TEST(OrientationSign, KnowsItsOwnSides) {
  EXPECT_EQ(OrientationSign(Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1)), 1);
  EXPECT_EQ(OrientationSign({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
}

// Products below the smallest doubles must be told, not rounded to a sign.
TEST(OrientationSign, TinyCoordinatesAreExactOrUnknown) {
  Random random(33);
  int unknown = 0, known = 0;
  const auto tiny = [&] {
    return random.Chance(0.2) ? 0.0
                              : (random.Chance(0.5) ? 1 : -1) * random.LogUniform(0x1p-1074, 1);
  };
  for (int i = 0; i < 20000; ++i) {
    const Vector3d a(tiny(), tiny(), tiny()), b(tiny(), tiny(), tiny()), c(tiny(), tiny(), tiny());
    const Vector3d p =
        random.Chance(0.5) ? Vector3d(tiny(), tiny(), tiny()) : Vector3d(0.5 * (b + c));
    const ExactPoint n = CrossOf(ExactOf(b) - ExactOf(a), ExactOf(c) - ExactOf(a));
    const auto plane =
        OrientationSign(Vector2d(a.head<2>()), Vector2d(b.head<2>()), Vector2d(c.head<2>()));
    const auto space = OrientationSign(a, b, c, p);
    const int expected = DotOf(n, ExactOf(p) - ExactOf(a)).sign();
    ASSERT_EQ(plane.value_or(n[2].sign()), n[2].sign());
    ASSERT_EQ(space.value_or(expected), expected);
    ++(space ? known : unknown);
  }
  EXPECT_GT(known, 1000);
  EXPECT_GT(unknown, 1000);
}

}  // namespace
}  // namespace collision::numeric
