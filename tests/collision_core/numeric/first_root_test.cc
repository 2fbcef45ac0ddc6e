// Goal:   the first root is never late, and early by little.
// Method: the gap at the root, and a little later, in exact arithmetic.
#include "collision_core/numeric/first_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random.h"
#include "tests/support/truth/exact.h"

namespace collision::numeric {
namespace {

TEST(FirstRoot, IsNeverLateAndNearlyTight) {
  Random random(61);
  int roots = 0;
  for (int i = 0; i < 20000; ++i) {
    const double gap = random.LogUniform(1e-9, 1e9), speed = random.LogUniform(1e-6, 1e6);
    const double closing = random.Chance(0.3) ? -speed : speed;
    const double growth = random.Chance(0.2) ? 0 : random.LogUniform(1e-9, 1e9);
    const double root = FirstRoot(gap, closing, growth);
    if (root == kInfinity) continue;
    ++roots;
    const auto left = [&](double x) {
      return Exact(gap) - Exact(closing) * Exact(x) - Exact(growth) * Exact(x) * Exact(x);
    };
    ASSERT_GE(left(root), 0) << gap << " " << closing << " " << growth;
    ASSERT_LE(left(root * (1 + 1e-6)), 0) << gap << " " << closing << " " << growth;
  }
  EXPECT_GT(roots, 10000);
}

// Goal:   magnitudes at which squares and quotients underflow or overflow make it no later.
// Method: every magnitude that a double has, for each of the three.
TEST(FirstRoot, IsNeverLateAtAnyMagnitude) {
  Random random(62);
  int roots = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto draw = [&random] {
      return std::ldexp(random.Uniform(1, 2), static_cast<int>(random.Below(2090)) - 1070);
    };
    const double gap = draw(), speed = draw();
    const double closing = random.Chance(0.1) ? 0 : random.Chance(0.3) ? -speed : speed;
    const double growth = random.Chance(0.3) ? 0 : draw();
    const double root = FirstRoot(gap, closing, growth);
    ASSERT_GE(root, 0);
    if (root == kInfinity) {
      const Exact last(std::numeric_limits<double>::max());
      ASSERT_GE(Exact(gap) - Exact(closing) * last - Exact(growth) * last * last, 0)
          << gap << " " << closing << " " << growth;
      continue;
    }
    roots += root > 0;
    ASSERT_GE(Exact(gap) - Exact(closing) * Exact(root) - Exact(growth) * Exact(root) * Exact(root),
              0)
        << gap << " " << closing << " " << growth;
  }
  EXPECT_GT(roots, 5000);
  EXPECT_EQ(FirstRoot(1, 0, 0), kInfinity);
  EXPECT_EQ(FirstRoot(1, -1, 0), kInfinity);
}

}  // namespace
}  // namespace collision::numeric
