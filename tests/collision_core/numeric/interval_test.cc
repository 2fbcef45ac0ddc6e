#include "collision_core/numeric/interval.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/truth/exact.h"

namespace collision::numeric {
namespace {

constexpr int kTrials = 50000;

/// Whole and half numbers, zeros, denormals and everything else that is finite.
double AnyNumber(Random& random) {
  const double sign = random.Chance(0.5) ? 1 : -1;
  switch (random.Below(6)) {
    case 0:
      return sign * 0.5 * static_cast<double>(random.Below(9));
    case 1:
      return sign * random.LogUniform(0x1p-1074, 0x1p-1000);
    case 2:
      return sign * random.LogUniform(1e280, 1.7e308);
    case 3:
      return sign * random.LogUniform(0x1p-1074, 1.7e308);
    default:
      return sign * random.LogUniform(1e-6, 1e6);
  }
}

Interval AnyInterval(Random& random) {
  const double a = AnyNumber(random), b = random.Chance(0.5) ? a : AnyNumber(random);
  return {std::min(a, b), std::max(a, b)};
}

double AnyOf(const Interval& interval, Random& random) {
  if (random.Chance(0.3)) return interval.lower;
  if (random.Chance(0.3)) return interval.upper;
  const double x = interval.middle();
  return interval.Contains(x) ? x : interval.lower;
}

Exact ExactOf(double x) { return Exact(x); }

/// Each end of the result for points is the exact value or the double next to it; near denormals
/// at most two doubles away.
void ExpectTight(const Interval& result, const Exact& exact, bool is_near_denormals) {
  double above = NextUp(result.lower), below = NextDown(result.upper);
  if (is_near_denormals) above = NextUp(above), below = NextDown(below);
  const bool is_exact =
      ExactOf(std::isinf(result.lower) ? 0 : result.lower) == exact && result.lower == result.upper;
  if (is_exact) return;
  EXPECT_FALSE(result.lower == result.upper);
  EXPECT_TRUE(std::isinf(above) || ExactOf(above) > exact);
  EXPECT_TRUE(std::isinf(below) || ExactOf(below) < exact);
}

// Goal:   sums, differences, products, quotients contain every exact result and waste at most one
// ulp. Method: exact rational arithmetic on operands of all magnitudes, points and wide intervals.
TEST(Interval, FourOperationsContainTheExactResult) {
  Random random(1);
  for (int i = 0; i < kTrials; ++i) {
    const Interval a = AnyInterval(random), b = AnyInterval(random);
    const double x = AnyOf(a, random), y = AnyOf(b, random);
    ASSERT_TRUE(Contains(a + b, ExactOf(x) + ExactOf(y))) << x << " + " << y;
    ASSERT_TRUE(Contains(a - b, ExactOf(x) - ExactOf(y))) << x << " - " << y;
    ASSERT_TRUE(Contains(a * b, ExactOf(x) * ExactOf(y))) << x << " * " << y;
    ASSERT_TRUE(Contains(Square(a), ExactOf(x) * ExactOf(x))) << x << " squared";
    if (y != 0) {
      ASSERT_TRUE(Contains(a / b, ExactOf(x) / ExactOf(y))) << x << " / " << y;
    }
  }
}

// Goal:   an exact result stays exact, a rounded one moves by one unit in the last place and no
// more. Method: points, whose results are known exactly.
TEST(Interval, PointsAreTight) {
  Random random(2);
  for (int i = 0; i < kTrials; ++i) {
    const double x = AnyNumber(random), y = AnyNumber(random);
    const auto is_small = [](double v) { return std::abs(v) < kExactErrorMin; };
    ExpectTight(Interval(x) + y, ExactOf(x) + ExactOf(y), false);
    ExpectTight(Interval(x) * y, ExactOf(x) * ExactOf(y), is_small(x * y));
    if (y != 0) {
      ExpectTight(Interval(x) / y, ExactOf(x) / ExactOf(y), is_small(x) || is_small(x / y));
    }
    ASSERT_FALSE(HasFailure()) << x << ", " << y;
  }
}

// Goal:   the greater, the lesser and the magnitude contain those of every two numbers, and each
// end is that of some two. Method: both ends against those of the operands.
TEST(Interval, GreaterLesserAndMagnitude) {
  Random random(5);
  for (int i = 0; i < kTrials; ++i) {
    const Interval a = AnyInterval(random), b = AnyInterval(random);
    const double x = AnyOf(a, random), y = AnyOf(b, random);
    ASSERT_TRUE(Max(a, b).Contains(std::max(x, y))) << x << ", " << y;
    ASSERT_TRUE(Min(a, b).Contains(std::min(x, y))) << x << ", " << y;
    ASSERT_TRUE(Abs(a).Contains(std::abs(x))) << x;
    ASSERT_EQ(Max(a, b).lower, std::max(a.lower, b.lower));
    ASSERT_EQ(Min(a, b).upper, std::min(a.upper, b.upper));
    ASSERT_EQ(Abs(a).upper, std::max(std::abs(a.lower), std::abs(a.upper)));
  }
}

// Goal:   what needs no rounding is not rounded: zero terms, halves and small whole numbers.
TEST(Interval, ExactResultsStayExact) {
  const auto expect_point = [](Interval result, double value) {
    EXPECT_EQ(result.lower, value);
    EXPECT_EQ(result.upper, value);
  };
  expect_point(Interval(1.5) + 0.25, 1.75);
  expect_point(Interval(3) * 0.5, 1.5);
  expect_point(Interval(3) / 2, 1.5);
  expect_point(Interval(0) * 1e308, 0);
  expect_point(Interval(0x1p-1074) + 0x1p-1074, 0x1p-1073);
  expect_point(Sqrt(49), 7);
  expect_point(Norm({2, 3, 6}), 7);
  expect_point(Norm({2e0 * 0x1p+700, 3 * 0x1p+700, 6 * 0x1p+700}), 7 * 0x1p+700);
}

// Goal:   roots and lengths contain the exact ones and are within a few ulps, over the whole range.
// Method: squares of the ends against the exact square.
TEST(Interval, RootsAndLengths) {
  Random random(3);
  for (int i = 0; i < kTrials; ++i) {
    const double x = std::abs(AnyNumber(random));
    const Interval root = Sqrt(x);
    ASSERT_LE(ExactOf(root.lower) * ExactOf(root.lower), ExactOf(x));
    ASSERT_GE(ExactOf(root.upper) * ExactOf(root.upper), ExactOf(x));
    ASSERT_LE(root.upper, NextUp(NextUp(root.lower)));

    const double a = AnyNumber(random), b = AnyNumber(random), c = AnyNumber(random);
    const Interval norm = Norm({a, b, c});
    const Exact square =
        ExactOf(a) * ExactOf(a) + ExactOf(b) * ExactOf(b) + ExactOf(c) * ExactOf(c);
    ASSERT_LE(ExactOf(norm.lower) * ExactOf(norm.lower), square) << a << b << c;
    if (std::isinf(norm.upper)) continue;
    ASSERT_GE(ExactOf(norm.upper) * ExactOf(norm.upper), square) << a << b << c;
    ASSERT_LE(norm.width(), 8 * 0x1p-52 * norm.upper + 0x1p-1073);
  }
}

// Goal:   infinite ends claim nothing false.
// Method: each undefined form by hand.
TEST(Interval, InfinitiesAreConservative) {
  const Interval unbounded(0, kInfinity);
  const Interval difference = unbounded - unbounded;
  EXPECT_EQ(difference.lower, -kInfinity);
  EXPECT_EQ(difference.upper, kInfinity);
  EXPECT_EQ((Interval(0) * unbounded).upper, 0);
  EXPECT_EQ((Interval(2) * unbounded).upper, kInfinity);
  EXPECT_EQ((Interval(1.7e308) + 1.7e308).lower, std::numeric_limits<double>::max());
  EXPECT_EQ((Interval(1.7e308) + 1.7e308).upper, kInfinity);
  EXPECT_EQ((Interval(1e200) * 1e200).lower, std::numeric_limits<double>::max());
  EXPECT_EQ((Interval(1) / Interval(-1, 1)).lower, -kInfinity);
  EXPECT_EQ((Interval(1) / Interval(0, 1)).upper, kInfinity);
}

}  // namespace
}  // namespace collision::numeric
