#include "collision_core/numeric/first_approach_quick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"
#include "tests/support/truth/exact_polynomial.h"

namespace collision::numeric {
namespace {

constexpr double kForever = INFINITY;

QuickApproach Make(double d, double w, double s0, double s1 = 0, double s2 = 0) {
  return {{{d, 0, 0}, {w, 0, 0}, s0, s1, s2}, 0, 0};
}

// Goal:   simple approaches are decided, never late and early by 1e-9 at most; a limit cuts.
TEST(QuickFirstApproach, KnownByHand) {
  const auto expect = [](const QuickApproach& approach, double exact) {
    const QuickAnswer answer = QuickFirstApproach(approach, kForever);
    EXPECT_TRUE(answer.decided);
    EXPECT_LE(answer.delta, exact);
    EXPECT_GE(answer.delta, exact * (1 - 1e-9));
  };
  expect(Make(12, -10, 2), 1);
  expect({{{6, 4, 0}, {-1, 0, 0}, 5, 0, 0}, 0, 0}, 3);
  expect(Make(18, 0, 0, 0, 2), 3);
  expect(Make(10, 2, 1, 5), 3);
  expect(Make(1, 0, 2), 0);
  expect(Make(1, 1, 0.5), kForever);
  EXPECT_EQ(QuickFirstApproach(Make(12, -10, 2), 0.5).delta, kForever);
  EXPECT_TRUE(QuickFirstApproach(Make(12, -10, 2), 0.5).decided);
}

// Goal:   what a few units in the last place decide, and magnitudes whose rounding is not relative,
//         are left to intervals, at a time that is certified; nothing infinite is taken for
//         decided.
TEST(QuickFirstApproach, LeavesTheRest) {
  for (const QuickApproach& approach :
       {Make(1, 0, 1), Make(1, 1, 1), Make(1e-200, 0, 0, 1e-200), Make(1e200, -1e200, 0),
        Make(1, 0, kForever), Make(kForever, 0, 1), Make(NAN, 0, 1), Make(1e-130, -1e-320, 0),
        Make(1, 0, 0, 1e-300), Make(1, 0, 0, 0, 5e-324)}) {
    const QuickAnswer answer = QuickFirstApproach(approach, kForever);
    EXPECT_FALSE(answer.decided) << approach.ball.c[0] << ' ' << approach.ball.s0;
    EXPECT_EQ(answer.delta, 0);
  }
  const QuickAnswer grazing =
      QuickFirstApproach({{{-1, 1, 0}, {1, 0, 0}, 1, 0, 0}, 0, 0}, kForever);
  EXPECT_FALSE(grazing.decided);
  EXPECT_LE(grazing.delta, 1);
  EXPECT_GE(grazing.delta, 1 - 1e-6);
}

/// Draws approaches, judges each, and returns how many were decided.
int JudgeApproaches(std::uint64_t seed, int approaches, bool bent, ProofCounts* counts) {
  Random random(seed);
  int decided = 0;
  for (int i = 0; i < approaches; ++i) {
    QuickBall a = {};
    const auto number = [&] {
      return std::ldexp(static_cast<double>(random.Below(64)), static_cast<int>(random.Below(12)));
    };
    const auto sign = [&] { return random.Chance(0.5) ? 1.0 : -1.0; };
    for (int k = 0; k < 3; ++k) a.c[k] = sign() * number(), a.v[k] = sign() * number();
    a.s0 = number() / 8;
    a.s1 = random.Chance(0.5) ? 0 : number() / 64;
    a.s2 = random.Chance(0.5) ? 0 : number() / 64;
    if (bent) {
      for (double& h : a.bend) h = random.Chance(0.3) ? 0 : sign() * number() / 64;
      a.s3 = random.Chance(0.3) ? 0 : number() / 256;
    }
    const QuickAnswer answer = QuickFirstApproach({a, 0, 0, 0, bent}, kForever);
    decided += answer.decided;
    DyadicPolynomial gap;
    for (int k = 0; k < 3; ++k) {
      const DyadicPolynomial d = {a.c[k], a.v[k], a.bend[k]};
      gap = gap + d * d;
    }
    const DyadicPolynomial reach = {a.s0, a.s1, a.s2, a.s3};
    gap = gap + Dyadic(-1) * (reach * reach);
    std::optional<Dyadic> end;
    if (answer.delta < kForever) end = answer.delta;
    EXPECT_TRUE(IsPositive(gap, 0, end, counts)) << i;
    if (!answer.decided || answer.delta == kForever || answer.delta == 0) continue;
    EXPECT_FALSE(IsPositive(gap, 0, Dyadic(answer.delta) * (Dyadic(1) + Dyadic(1e-9)), counts))
        << i;
  }
  return decided;
}

// Goal:   decided or not, no approach before the time given, to the last bit; decided, one by it
// and
//         1e-9 of it.
// Method: numbers with few bits and of many magnitudes, exact Sturm chains; they are exact inputs.
TEST(QuickFirstApproach, NeverLate) {
  constexpr int kApproaches = 20000;
  ProofCounts counts;
  EXPECT_GT(JudgeApproaches(71, kApproaches, false, &counts), kApproaches * 9 / 10);
  EXPECT_GT(counts.sturm, 0u);
}

// Goal:   likewise where the centre bends and the reach grows with a jerk.
TEST(QuickFirstApproach, NeverLateWhereItBends) {
  constexpr int kApproaches = 20000;
  ProofCounts counts;
  EXPECT_GT(JudgeApproaches(75, kApproaches, true, &counts), kApproaches * 9 / 10);
  EXPECT_GT(counts.sturm, 0u);
}

}  // namespace
}  // namespace collision::numeric
