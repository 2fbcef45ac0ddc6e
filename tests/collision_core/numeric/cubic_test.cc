#include "collision_core/numeric/cubic.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/truth/exact.h"

namespace collision::numeric {
namespace {

// Goal:   FirstZero is never past the zero and within 1e-14 of it, for all magnitudes and signs.
// Method: the exact sign of the quadratic at the answer and just behind it.
TEST(Cubic, FirstZeroIsCertifiedAndTight) {
  Random random(11);
  for (int i = 0; i < 50000; ++i) {
    const double gap = random.LogUniform(1e-12, 1e12);
    const double closing = (random.Chance(0.5) ? 1 : -1) * random.LogUniform(1e-12, 1e12);
    const double growth = random.Chance(0.2) ? 0 : random.LogUniform(1e-12, 1e12);
    const double zero = FirstZero(gap, closing, growth);
    if (growth == 0 && closing <= 0) {
      ASSERT_EQ(zero, kInfinity);
      continue;
    }
    const ExactPolynomial p = {Exact(gap), Exact(-closing), Exact(-growth)};
    ASSERT_GE(Evaluate(p, Exact(zero)), 0) << gap << " " << closing << " " << growth;
    ASSERT_LE(Evaluate(p, Exact(zero * (1 + 1e-14))), 0) << gap << " " << closing << " " << growth;
  }
}

// Goal:   no gap: at once; nothing closes: never; extreme coefficients neither overflow nor vanish.
TEST(Cubic, FirstZeroAtTheExtremes) {
  EXPECT_EQ(FirstZero(0, 1, 1), 0);
  EXPECT_EQ(FirstZero(-1, 0, 0), 0);
  EXPECT_EQ(FirstZero(1, 0, 0), kInfinity);
  EXPECT_EQ(FirstZero(1, -1, 0), kInfinity);
  EXPECT_NEAR(FirstZero(1e300, 0, 1e-300), 1e300, 1e287);
  EXPECT_NEAR(FirstZero(1e18, 0, 1e18), 1, 1e-14);
  EXPECT_GT(FirstZero(1e-300, 1, 1), 0.999e-300);
}

/// Whether gap − closing x − growth x² − jerk x³ stays above 0 before `end`, and where `tight`, has
/// reached 0 by the end and `ahead` of it.
void ExpectFirstZero(const double (&c)[4], double tight) {
  const double zero = FirstZero(c[0], c[1], c[2], c[3]);
  const ExactPolynomial p = {Exact(c[0]), Exact(-c[1]), Exact(-c[2]), Exact(-c[3])};
  ASSERT_GT(zero, 0);
  if (zero == kInfinity) {
    // Without an end: none up to 2^300, which is beyond every root of such coefficients.
    ASSERT_EQ(CountRoots(p, 0, Exact(0x1p300)), 0);
    return;
  }
  const Exact end(zero);
  ASSERT_GE(Evaluate(p, end), 0);
  ASSERT_EQ(CountRoots(p, 0, end), Evaluate(p, end) == 0 ? 1 : 0);
  ASSERT_GT(CountRoots(p, 0, end * (1 + Exact(tight))), 0) << zero;
}

// Goal:   with jerk, and with growth of either sign: never past the first zero, and near it, also
//         where the gap opens again before it closes for good.
// Method: Sturm's theorem on the cubic, for all magnitudes and signs.
TEST(Cubic, FirstZeroWithJerkIsCertifiedAndTight) {
  Random random(13);
  const auto any = [&] { return random.LogUniform(1e-9, 1e9); };
  const auto sign = [&] { return random.Chance(0.5) ? 1.0 : -1.0; };
  for (int i = 0; i < 20000; ++i) {
    const double jerk = random.Chance(0.2) ? 0 : any();
    ExpectFirstZero({any(), sign() * any(), sign() * any(), jerk}, 1e-6);
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
}

// Goal:   likewise where two zeros are near each other: the gap almost closes, opens, and closes.
// Method: (x − a)² (x − b) = 0, moved by 1e-12 to 1e-2, to either side.
TEST(Cubic, FirstZeroNearADoubleZero) {
  Random random(14);
  for (int i = 0; i < 20000; ++i) {
    const double a = random.Uniform(0.1, 2), b = random.Uniform(2, 9);
    const double off = random.LogUniform(1e-12, 1e-2) * (random.Chance(0.5) ? 1 : -1);
    // −(x − a)² (x − b) = a² b − (2 a b + a²) x + (2 a + b) x² − x³.
    ExpectFirstZero({a * a * b + off, 2 * a * b + a * a, -(2 * a + b), 1}, 1e-5);
    ASSERT_FALSE(HasFatalFailure()) << i << ' ' << a << ' ' << b << ' ' << off;
  }
}

// Goal:   extremes are defined: no gap, overflow, underflow.
TEST(Cubic, FirstZeroWithJerkAtTheExtremes) {
  EXPECT_EQ(FirstZero(0, 1, 1, 1), 0);
  EXPECT_EQ(FirstZero(1, -1, -1, 0), kInfinity);
  EXPECT_EQ(FirstZero(1, 1, -1, 0), kInfinity);
  EXPECT_NEAR(FirstZero(8, 0, 0, 1), 2, 1e-11);
  for (const double scale : {1e-300, 1e-100, 1e100, 1e300}) {
    EXPECT_GE(FirstZero(scale, 0, 0, 1), 0) << scale;
    EXPECT_GE(FirstZero(1, 0, 0, scale), 0) << scale;
    EXPECT_GE(FirstZero(1, -scale, scale, scale), 0) << scale;
    EXPECT_LE(FirstZero(1, 0, 0, scale), std::cbrt(1 / scale)) << scale;
  }
}

// Goal:   a cubic seen from elsewhere, forward or backward, has the same values.
TEST(Cubic, ShiftsContainTheExactValues) {
  Random random(12);
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&] { return random.Uniform(-9, 9); };
    const double c0 = any(), c1 = any(), c2 = any(), c3 = random.Chance(0.3) ? 0 : any();
    const double start = random.Uniform(0, 9), x = random.Uniform(0, 9);
    const Cubic q{c0, c1, c2, c3};
    const ExactPolynomial p = {Exact(c0), Exact(c1), Exact(c2), Exact(c3)};
    ASSERT_TRUE(Contains(q.From(start).At(x), Evaluate(p, Exact(start) + Exact(x))));
    ASSERT_TRUE(Contains(q.BackwardFrom(start).At(x), Evaluate(p, Exact(start) - Exact(x))));
  }
}

}  // namespace
}  // namespace collision::numeric
