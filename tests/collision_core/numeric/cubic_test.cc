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

// Goal:   a quadratic seen from elsewhere, forward or backward, has the same values.
TEST(Cubic, ShiftsContainTheExactValues) {
  Random random(12);
  for (int i = 0; i < 2000; ++i) {
    const double c0 = random.Uniform(-9, 9), c1 = random.Uniform(-9, 9), c2 = random.Uniform(-9, 9);
    const double start = random.Uniform(0, 9), x = random.Uniform(0, 9);
    const Cubic q{c0, c1, c2};
    const ExactPolynomial p = {Exact(c0), Exact(c1), Exact(c2)};
    ASSERT_TRUE(Contains(q.From(start).At(x), Evaluate(p, Exact(start) + Exact(x))));
    ASSERT_TRUE(Contains(q.BackwardFrom(start).At(x), Evaluate(p, Exact(start) - Exact(x))));
  }
}

}  // namespace
}  // namespace collision::numeric
