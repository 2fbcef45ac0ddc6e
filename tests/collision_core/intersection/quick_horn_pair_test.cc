#include "collision_core/intersection/quick_horn_pair.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/truth/exact_bound.h"

namespace collision::intersection {
namespace {

motion::SpaceTimeBound AnyAgent(Random& random) {
  const auto any = [&random] { return random.LogUniform(1e-6, 1e6); };
  motion::SpaceTimeBound bound;
  bound.state.p_WA = any() * random.UnitVector();
  bound.state.v_WA = any() * random.UnitVector();
  if (random.Chance(0.5)) {
    // |(2, 3, 6)| = 7: the oracle needs a rational |v| κ.
    bound.state.v_WA = std::ldexp(1.0, std::ilogb(any())) * Eigen::Vector3d(2, 3, 6);
    bound.skew = random.LogUniform(1e-9, 1);
  }
  bound.state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(1ull << 33)));
  bound.state.position_error = any();
  bound.state.velocity_error = any();
  bound.limits.radius = any();
  bound.limits.acceleration_max = any();
  bound.limits.time_step = random.LogUniform(1e-6, 1);
  return bound;
}

/// The same with a known acceleration, jerk or both; |a| rational.
motion::SpaceTimeBound AnyBentAgent(Random& random) {
  const auto any = [&random] { return random.LogUniform(1e-6, 1e6); };
  motion::SpaceTimeBound bound = AnyAgent(random);
  if (random.Chance(0.7)) {
    bound.state.a_WA = std::ldexp(1.0, std::ilogb(any())) * Eigen::Vector3d(6, -2, 3);
  }
  if (random.Chance(0.7)) bound.limits.jerk_max = any();
  return bound;
}

// Goal:   what the doubles of a pair do not know is in its reach, term by term, and not more than
//         twice what is said to be.
// Method: exact coefficients; |exact d − d| + exact s0 <= s0, likewise w and s1.
TEST(QuickHornPair, ReachesContainTheRounding) {
  Random random(72);
  for (int i = 0; i < 4000; ++i) {
    const motion::SpaceTimeBound a = AnyAgent(random), b = AnyAgent(random);
    const Instant base = Instant::FromNanoseconds(1ll << 33);
    const numeric::QuickApproach q = QuickHornPair({a, b, base});
    const ExactHorn horn_A(a, base), horn_B(b, base);
    Exact off_d = 0, off_w = 0;
    for (int k = 0; k < 3; ++k) {
      const Exact d = horn_B.p[k] - horn_A.p[k] - Exact(q.ball.c[k]);
      const Exact w = horn_B.v[k] - horn_A.v[k] - Exact(q.ball.v[k]);
      off_d += d * d;
      off_w += w * w;
    }
    const Exact s0 = Exact(a.limits.radius) + Exact(b.limits.radius) + horn_A.u[0] + horn_B.u[0];
    const Exact s1 = horn_A.u[1] + horn_B.u[1], s2 = horn_A.u[2] + horn_B.u[2];
    const Exact more0 = Exact(q.ball.s0) - s0, more1 = Exact(q.ball.s1) - s1;
    ASSERT_GE(more0, 0);
    ASSERT_GE(more0 * more0, off_d);
    ASSERT_GE(more1, 0);
    ASSERT_GE(more1 * more1, off_w);
    ASSERT_GE(Exact(q.ball.s2), s2);
    ASSERT_LE(more0, 2 * Exact(q.doubt0));
    ASSERT_LE(more1, 2 * Exact(q.doubt1));
    ASSERT_LE(Exact(q.ball.s2), s2 * (1 + Exact(0x1p-46)));
    // Turned about, the same numbers.
    const numeric::QuickApproach turned = QuickHornPair({b, a, base});
    ASSERT_EQ(turned.ball.s0, q.ball.s0);
    ASSERT_EQ(turned.ball.s1, q.ball.s1);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(turned.ball.c[k], -q.ball.c[k]);
  }
}

// Goal:   small reaches beside large distances: the allowances alone carry the rounding.
// Method: points without acceleration; then s0 and s1 are nothing but allowance.
TEST(QuickHornPair, PointsHaveTheirAllowance) {
  Random random(73);
  for (int i = 0; i < 4000; ++i) {
    motion::SpaceTimeBound a, b;
    for (motion::SpaceTimeBound* bound : {&a, &b}) {
      bound->state.p_WA = random.LogUniform(1e-3, 1e3) * random.UnitVector();
      bound->state.v_WA = random.LogUniform(1e-3, 1e3) * random.UnitVector();
      bound->state.stamp =
          Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(1ull << 33)));
    }
    const Instant base = Instant::FromNanoseconds(1ll << 33);
    const numeric::QuickApproach q = QuickHornPair({a, b, base});
    const ExactHorn horn_A(a, base), horn_B(b, base);
    Exact off_d = 0, off_w = 0;
    for (int k = 0; k < 3; ++k) {
      const Exact d = horn_B.p[k] - horn_A.p[k] - Exact(q.ball.c[k]);
      const Exact w = horn_B.v[k] - horn_A.v[k] - Exact(q.ball.v[k]);
      off_d += d * d;
      off_w += w * w;
    }
    ASSERT_GE(Exact(q.ball.s0) * Exact(q.ball.s0), off_d);
    ASSERT_GE(Exact(q.ball.s1) * Exact(q.ball.s1), off_w);
  }
}

// Goal:   likewise with known accelerations and jerk, coefficient by coefficient.
// Method: |exact h − h| + exact s2 <= s2, and s3 alone.
TEST(QuickHornPair, BentReachesContainTheRounding) {
  Random random(74);
  for (int i = 0; i < 4000; ++i) {
    const motion::SpaceTimeBound a = AnyBentAgent(random), b = AnyBentAgent(random);
    const Instant base = Instant::FromNanoseconds(1ll << 33);
    const numeric::QuickApproach q = QuickHornPair({a, b, base});
    ASSERT_EQ(q.bends, Bends(a) || Bends(b));
    const ExactHorn horn_A(a, base), horn_B(b, base);
    Exact off[3] = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      const Exact d = horn_B.p[k] - horn_A.p[k] - Exact(q.ball.c[k]);
      const Exact w = horn_B.v[k] - horn_A.v[k] - Exact(q.ball.v[k]);
      const Exact h = horn_B.h[k] - horn_A.h[k] - Exact(q.ball.bend[k]);
      off[0] += d * d, off[1] += w * w, off[2] += h * h;
    }
    Exact exact[4] = {Exact(a.limits.radius) + Exact(b.limits.radius), 0, 0, 0};
    for (const ExactHorn* horn : {&horn_A, &horn_B}) {
      for (std::size_t k = 0; k < horn->u.size(); ++k) exact[k] += horn->u[k];
    }
    const double reach[3] = {q.ball.s0, q.ball.s1, q.ball.s2};
    const double doubt[3] = {q.doubt0, q.doubt1, q.doubt2};
    for (int k = 0; k < (q.bends ? 3 : 2); ++k) {
      const Exact more = Exact(reach[k]) - exact[k];
      ASSERT_GE(more, 0) << k;
      ASSERT_GE(more * more, off[k]) << k;
      ASSERT_LE(more, 2 * Exact(doubt[k])) << k;
    }
    ASSERT_GE(Exact(q.ball.s3), exact[3]);
    ASSERT_LE(Exact(q.ball.s3), exact[3] * (1 + Exact(0x1p-49)));
  }
}

}  // namespace
}  // namespace collision::intersection
