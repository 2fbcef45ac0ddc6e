#include "collision_core/intersection/earliest_intersection.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact_bound.h"

namespace collision::intersection {
namespace {

constexpr int kPairs = kSanitized ? 300 : 4000;

constexpr std::int64_t kSecond = 1'000'000'000;

motion::SpaceTimeBound Ball(const Eigen::Vector3d& p, const Eigen::Vector3d& v, double radius,
                            double acceleration_max = 0) {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

/// The exact pair polynomial |Δp|² − S², and what its inputs' rounding may amount to.
struct ExactPair {
  ExactPolynomial distance_square, reach, gap;
  Exact magnitude_0 = 0, magnitude_1 = 0;  ///< Of the terms at 0 and of those that grow with time.

  ExactPair(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, Instant base) {
    const ExactHorn horn_A(a, base), horn_B(b, base);
    distance_square.assign(3, Exact(0));
    for (int i = 0; i < 3; ++i) {
      const Exact d = horn_B.p[i] - horn_A.p[i], w = horn_B.v[i] - horn_A.v[i];
      distance_square[0] += d * d;
      distance_square[1] += 2 * d * w;
      distance_square[2] += w * w;
      const Exact shift_A = horn_A.p[i] - Exact(a.state.p_WA[i]);
      const Exact shift_B = horn_B.p[i] - Exact(b.state.p_WA[i]);
      magnitude_0 +=
          abs(Exact(b.state.p_WA[i]) - Exact(a.state.p_WA[i])) + abs(shift_A) + abs(shift_B);
      magnitude_1 += abs(w);
    }
    reach = horn_A.u;
    for (int i = 0; i < 3; ++i) reach[i] += horn_B.u[i];
    reach[0] += Exact(a.limits.radius) + Exact(b.limits.radius);
    gap = Multiply(reach, reach);
    for (int i = 0; i < 5; ++i) gap[i] = (i < 3 ? distance_square[i] : Exact(0)) - gap[i];
  }

  bool Overlaps(const Exact& t) const { return Evaluate(gap, t) <= 0; }

  /// Do they overlap anywhere in [0, end)?
  bool OverlapsBefore(const Exact& end) const {
    if (end <= 0) return false;
    return Overlaps(0) || CountRoots(gap, 0, end) > (Overlaps(end) && Evaluate(gap, end) == 0);
  }

  /// Later than every root.
  Exact RootsEnd() const {
    ExactPolynomial p = gap;
    while (!p.empty() && p.back() == 0) p.pop_back();
    Exact end = 1;
    for (const Exact& c : p) end = std::max(end, Exact(1 + abs(c / p.back())));
    return end;
  }

  /// Would a few units in the last place of the inputs make them overlap at t?
  bool NearlyOverlaps(const Exact& t) const {
    const Exact allowance =
        Exact(64 * 0x1p-52) * (magnitude_0 + magnitude_1 * t + Evaluate(reach, t));
    const Exact reached = Evaluate(reach, t) + allowance;
    return Evaluate(distance_square, t) <= reached * reached;
  }
};

void ExpectCertified(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b,
                     Instant from) {
  const IntersectionTime time = EarliestIntersection(a, b, from);
  const IntersectionTime swapped = EarliestIntersection(b, a, from);
  ASSERT_EQ(time.seconds, swapped.seconds);
  ASSERT_EQ(time.base, swapped.base);
  ASSERT_EQ(time.base, std::max({from, a.state.stamp, b.state.stamp}));
  if (NeverMoves(a) && NeverMoves(b)) {
    ASSERT_EQ(time.seconds, numeric::kInfinity);
    return;
  }
  const ExactPair pair(a, b, time.base);
  const Instant expiry = std::min(a.state.expiry, b.state.expiry);
  const bool expires = !expiry.is_never();
  const Exact end = expires ? ExactSeconds(time.base, expiry) : pair.RootsEnd();
  if (std::isinf(time.seconds)) {
    ASSERT_FALSE(pair.OverlapsBefore(end));
    return;
  }
  ASSERT_TRUE(!expires || Exact(time.seconds) < end);
  ASSERT_FALSE(pair.OverlapsBefore(Exact(time.seconds))) << time.seconds;
  const Exact soon = Exact(time.seconds) * (1 + Exact(1) / 1000000000);
  ASSERT_TRUE(pair.NearlyOverlaps(Exact(time.seconds)) || pair.NearlyOverlaps(soon) ||
              CountRoots(pair.gap, 0, soon) > 0)
      << "idle: " << time.seconds;
}

double Magnitude(Random& random) { return random.LogUniform(1e-12, 1e12); }

double MagnitudeOrZero(Random& random) { return random.Chance(0.2) ? 0 : Magnitude(random); }

motion::SpaceTimeBound AnyAgent(Random& random) {
  motion::SpaceTimeBound bound =
      Ball(Magnitude(random) * random.UnitVector(), MagnitudeOrZero(random) * random.UnitVector(),
           MagnitudeOrZero(random), MagnitudeOrZero(random));
  if (random.Chance(0.3)) bound.state.stamp = Instant::FromNanoseconds(random.Below(kSecond));
  if (random.Chance(0.1)) bound.state.stamp = Instant::FromNanoseconds(random.Next() >> 2);
  if (random.Chance(0.2)) bound.limits.time_step = random.LogUniform(1e-6, 1);
  if (random.Chance(0.2)) bound.state.position_error = Magnitude(random);
  if (random.Chance(0.2)) bound.state.velocity_error = Magnitude(random);
  return bound;
}

// Goal:   never late and not idle, over 24 orders of magnitude of everything.
// Method: Sturm's theorem on the exact quartic.
TEST(EarliestIntersection, AllMagnitudes) {
  Random random(61);
  for (int i = 0; i < kPairs; ++i) {
    ExpectCertified(AnyAgent(random), AnyAgent(random), Instant());
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
}

// Goal:   likewise where meetings are likely: comparable magnitudes, far from the origin, with
// expiries. Method: positions within 100 m of a common offset of up to 1e12 m.
TEST(EarliestIntersection, ComparableMagnitudes) {
  Random random(62);
  for (int i = 0; i < kPairs; ++i) {
    const Eigen::Vector3d offset = MagnitudeOrZero(random) * random.UnitVector();
    const auto agent = [&] {
      motion::SpaceTimeBound bound =
          Ball(offset + 100 * random.Uniform(0, 1) * random.UnitVector(),
               random.LogUniform(0.1, 100) * random.UnitVector(), random.Uniform(0, 10),
               random.Chance(0.3) ? 0 : random.Uniform(0, 1));
      bound.state.stamp = Instant::FromNanoseconds(random.Below(kSecond));
      if (random.Chance(0.3)) {
        bound.state.expiry = Instant::FromNanoseconds(kSecond + random.Below(20 * kSecond));
      }
      return bound;
    };
    const motion::SpaceTimeBound a = agent(), b = agent();
    ExpectCertified(a, b, Instant::FromNanoseconds(kSecond / 2));
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
}

// Goal:   grazing from both sides: radii that touch exactly, one unit in the last place more, and
// one less. Method: passing at the distance of the radii, with and without growth, any scale.
TEST(EarliestIntersection, Grazing) {
  Random random(63);
  for (int i = 0; i < kPairs; ++i) {
    const double scale = Magnitude(random), miss = scale * random.Uniform(0.1, 2);
    const double speed = Magnitude(random), time = random.LogUniform(1e-3, 1e3);
    double radius = miss;
    if (random.Chance(0.3)) radius = numeric::NextUp(miss);
    if (random.Chance(0.3)) radius = numeric::NextDown(miss);
    if (random.Chance(0.2)) radius = miss * (1 + random.LogUniform(1e-15, 1e-3));
    if (random.Chance(0.2)) radius = miss * (1 - random.LogUniform(1e-15, 1e-3));
    const double growth =
        random.Chance(0.5) ? 0 : 0.1 * random.Uniform(0, 1) * miss / (time * time);
    ExpectCertified(
        Ball({0, 0, 0}, {0, 0, 0}, std::max(0.0, radius - growth * time * time / 2), growth),
        Ball({-speed * time, miss, 0}, {speed, 0, 0}, 0), Instant());
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
}

// Goal:   near triple roots, where a tangent alone creeps, the answer is still not idle.
// Method: |d| = √(1 + (δ − c³)²) and S = r + s2 δ² share value, slope and curvature at δ = c + c³
//         for s2 = ½ (1 + c²)^(−3/2) and r = (1 − c²/2) √(1 + c²); scaled, and off by 1e-16 to
//         1e-2.
TEST(EarliestIntersection, NearTripleRoots) {
  Random random(64);
  for (int i = 0; i < kPairs; ++i) {
    const double c = random.Uniform(0.1, 1.4), size = std::sqrt(1 + c * c);
    const double scale = random.LogUniform(1e-6, 1e6), clock = random.LogUniform(1e-3, 1e3);
    double r = (1 - c * c / 2) * size, M = 1 / (size * size * size);
    if (random.Chance(0.7)) r *= 1 + random.LogUniform(1e-16, 1e-2) * (random.Chance(0.5) ? 1 : -1);
    if (random.Chance(0.7)) M *= 1 + random.LogUniform(1e-16, 1e-2) * (random.Chance(0.5) ? 1 : -1);
    ExpectCertified(
        Ball({0, 0, 0}, {0, 0, 0}, std::max(0.0, r) * scale, M * scale / (clock * clock)),
        Ball({-c * c * c * scale, scale, 0}, {scale / clock, 0, 0}, 0), Instant());
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
}

// Goal:   skew widens both horns as documented, and directions never make the answer later than the
// exact one. Method: velocities of rational length for the exact |v| κ.
TEST(EarliestIntersection, SkewIsCountedIn) {
  Random random(65);
  for (int i = 0; i < kPairs / 4; ++i) {
    const auto agent = [&] {
      motion::SpaceTimeBound bound =
          Ball(100 * random.UnitVector(), Eigen::Vector3d(2, 3, 6) * random.Below(4),
               random.Uniform(0, 1), random.Uniform(0, 1));
      bound.skew = random.LogUniform(1e-6, 0.5);
      return bound;
    };
    const motion::SpaceTimeBound a = agent(), b = agent();
    ExpectCertified(a, b, Instant::FromNanoseconds(kSecond));
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
}

// Goal:   head on, from inside, identical, receding, masked, expired: the plain cases.
TEST(EarliestIntersection, PlainCasesAreAsKnown) {
  motion::SpaceTimeBound a = Ball({0, 0, 0}, {10, 0, 0}, 1), b = Ball({12, 0, 0}, {0, 0, 0}, 1);
  const auto seconds = [&] { return EarliestIntersection(a, b, Instant()).seconds; };
  EXPECT_LE(seconds(), 1.0);
  EXPECT_GE(seconds(), 1 - 1e-9);
  EXPECT_EQ(EarliestIntersection(a, a, Instant()).seconds, 0);
  EXPECT_EQ(EarliestIntersection(a, b, Instant::FromNanoseconds(kSecond)).seconds, 0);
  EXPECT_EQ(EarliestIntersection(a, b, Instant::FromNanoseconds(kSecond * 6 / 5)).seconds, 0);
  EXPECT_EQ(EarliestIntersection(a, b, Instant::FromNanoseconds(2 * kSecond)).seconds,
            numeric::kInfinity);

  b.state.expiry = Instant::FromNanoseconds(kSecond / 2);
  EXPECT_EQ(seconds(), numeric::kInfinity);
  b.state.expiry = Instant::FromNanoseconds(kSecond + 1);
  EXPECT_LE(seconds(), 1.0);
  b.state.expiry = Instant();
  EXPECT_EQ(seconds(), numeric::kInfinity);
  b.state.expiry = Instant::Never();

  a.state.v_WA.x() = -10;
  EXPECT_EQ(seconds(), numeric::kInfinity);
  EXPECT_TRUE(EarliestIntersection(a, b, Instant()).instant().is_never());
}

// Goal:   a direction postpones the meeting while it holds, exactly as far as the box says, and not
//         after. Method: A thrusts only away from B (d = −x, M = 2, ½Mτ² = τ²), B rests 16 m off
//         along +x: never, while it holds; until 4 s: at 4 s, when the balls already overlap; until
//         2 s: at 4 s, the balls' time.
TEST(EarliestIntersection, DirectionsAreCountedIn) {
  motion::SpaceTimeBound a = Ball({0, 0, 0}, {0, 0, 0}, 0, 2), b = Ball({16, 0, 0}, {0, 0, 0}, 0);
  const auto seconds = [&] {
    const double time = EarliestIntersection(a, b, Instant()).seconds;
    EXPECT_EQ(time, EarliestIntersection(b, a, Instant()).seconds);
    return time;
  };
  EXPECT_NEAR(seconds(), 4, 1e-9);
  a.state.direction = {-1, 0, 0};
  EXPECT_EQ(seconds(), numeric::kInfinity);
  a.state.direction_until = Instant::FromNanoseconds(2 * kSecond);
  EXPECT_NEAR(seconds(), 4, 1e-9);
  a.state.direction_until = Instant::FromNanoseconds(6 * kSecond);
  EXPECT_NEAR(seconds(), 6, 1e-9);
  EXPECT_LE(seconds(), 6);
  a.skew = 0.5;
  EXPECT_NEAR(seconds(), 5.5, 1e-9);
  a.skew = 0;
  a.state.direction = {-0.6, 0.8, 0};
  EXPECT_NEAR(seconds(), 4 / std::sqrt(0.8), 1e-9);
  a.state.direction = {1, 0, 0};
  EXPECT_NEAR(seconds(), 4, 1e-9);
}

// Goal:   no motion that honours M and its direction meets before the time given.
// Method: random constant accelerations in the half space; the closed form of their distance is
// sampled.
TEST(EarliestIntersection, DirectedMotionsAreNeverLate) {
  Random random(66);
  int postponed = 0;
  for (int i = 0; i < kPairs; ++i) {
    motion::SpaceTimeBound a = Ball(20 * random.UnitVector(), 3 * random.UnitVector(), 1, 2);
    const motion::SpaceTimeBound b = Ball({0, 0, 0}, {0, 0, 0}, 1);
    const double without = EarliestIntersection(a, b, Instant()).seconds;
    a.state.direction = random.UnitVector();
    a.state.direction_until = Instant::FromNanoseconds(random.Below(10 * kSecond));
    const IntersectionTime time = EarliestIntersection(a, b, Instant());
    ASSERT_GE(time.seconds, without);
    postponed += time.seconds > without;
    const double until = numeric::SecondsBetween(Instant(), a.state.direction_until).lower;
    for (int motion = 0; motion < 20; ++motion) {
      Eigen::Vector3d first = 2 * random.UnitVector();
      if (first.dot(a.state.direction) < 0) first = -first;
      const Eigen::Vector3d second = -2 * a.state.p_WA.normalized();
      for (int sample = 0; sample < 20; ++sample) {
        const double t = random.Uniform(0, std::min(time.seconds, 20.0));
        const double t1 = std::min(t, until), t2 = t - t1;
        const Eigen::Vector3d v1 = a.state.v_WA + t1 * first;
        const Eigen::Vector3d p = a.state.p_WA + t1 * a.state.v_WA + 0.5 * t1 * t1 * first +
                                  t2 * v1 + 0.5 * t2 * t2 * second;
        ASSERT_GT(p.norm(), 2 - 1e-9) << t << " before " << time.seconds;
      }
    }
  }
  EXPECT_GT(postponed, kPairs / 20);
}

}  // namespace
}  // namespace collision::intersection
