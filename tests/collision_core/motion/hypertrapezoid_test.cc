#include "collision_core/motion/hypertrapezoid.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_bound.h"

namespace collision::motion {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

SpaceTimeBound AnyBound(Random& random, double range) {
  SpaceTimeBound bound;
  bound.state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(kSecond)));
  bound.state.p_WA = random.LogUniform(1e-3, range) * random.UnitVector();
  bound.state.v_WA = random.LogUniform(1e-3, 1e2) * random.UnitVector();
  bound.state.position_error = random.Uniform(0, 0.1);
  bound.state.velocity_error = random.Uniform(0, 0.1);
  bound.limits.radius = random.Uniform(0, 1);
  bound.limits.acceleration_max = random.Chance(0.2) ? 0 : random.LogUniform(1e-3, 1e2);
  bound.limits.time_step = random.Chance(0.5) ? 0 : 0.125;
  if (random.Chance(0.4)) {
    bound.state.a_WA =
        std::ldexp(1.0, static_cast<int>(random.Below(12)) - 8) * Eigen::Vector3d(2, -3, 6);
  }
  if (random.Chance(0.3)) bound.limits.jerk_max = random.LogUniform(1e-3, 1e2);
  return bound;
}

Exact Chord(double start, double end, const Exact& fraction) {
  return Exact(start) + (Exact(end) - Exact(start)) * fraction;
}

/// The exact lower and upper face of the horn's box.
std::pair<Exact, Exact> Faces(const SpaceTimeBound& bound, Instant t, int axis) {
  const ExactHorn horn(bound, t);
  const Exact reach = horn.u[0] + Exact(bound.limits.radius);
  return {horn.p[axis] - reach, horn.p[axis] + reach};
}

// Goal:   the hypertrapezoid contains the horn's exact box at every instant of the window and fits
// at its ends. Method: exact faces at random nanoseconds.
TEST(Hypertrapezoid, ContainsTheBoxAndFitsAtTheEnds) {
  Random random(41);
  for (int i = 0; i < 2000; ++i) {
    const SpaceTimeBound bound = AnyBound(random, 1e9);
    const Instant start = Instant::FromNanoseconds(kSecond + random.Below(9 * kSecond));
    const std::int64_t length = 1 + static_cast<std::int64_t>(random.Below(5 * kSecond));
    const Instant end = Instant::FromNanoseconds(start.nanoseconds() + length);
    const Hypertrapezoid h = MakeHypertrapezoid(bound, start, end);
    for (int sample = 0; sample <= 4; ++sample) {
      const std::int64_t after = sample == 0 ? 0 : sample == 1 ? length : random.Below(length);
      const Instant t = Instant::FromNanoseconds(start.nanoseconds() + after);
      const Exact fraction = Exact(after) / Exact(length);
      for (int axis = 0; axis < 3; ++axis) {
        const auto [lower, upper] = Faces(bound, t, axis);
        ASSERT_LE(Chord(h.lower_start[axis], h.lower_end[axis], fraction), lower);
        ASSERT_GE(Chord(h.upper_start[axis], h.upper_end[axis], fraction), upper);
        if (sample > 1) continue;
        const double scale = bound.state.p_WA.norm() + 1e5;
        const double bulge = 0.125 * bound.state.a_WA.norm() * 25;
        const Exact slack(8 * 0x1p-52 * scale + bulge);
        ASSERT_GE(Chord(h.lower_start[axis], h.lower_end[axis], fraction), lower - slack);
        ASSERT_LE(Chord(h.upper_start[axis], h.upper_end[axis], fraction), upper + slack);
      }
    }
    ASSERT_LE(Exact(h.duration), ExactSeconds(start, end));
  }
}

/// The exact gap between the two on the axis where it is largest.
Exact LargestGap(const Hypertrapezoid& a, const Hypertrapezoid& b, const Exact& fraction) {
  Exact largest = -1000000000;
  for (int axis = 0; axis < 3; ++axis) {
    const auto gap = [&](const Hypertrapezoid& below, const Hypertrapezoid& above) {
      return Chord(above.lower_start[axis], above.lower_end[axis], fraction) -
             Chord(below.upper_start[axis], below.upper_end[axis], fraction);
    };
    largest = std::max({largest, Exact(gap(a, b)), Exact(gap(b, a))});
  }
  return largest;
}

// Goal:   FirstOverlap is not later than the first overlap and within rounding of it; never means
// none. Method: exact gaps at the answer, just before it and at instants spread over the window.
TEST(Hypertrapezoid, FirstOverlapIsCertifiedAndTight) {
  Random random(42);
  int overlaps = 0, late_overlaps = 0;
  for (int i = 0; i < 4000; ++i) {
    const Instant start = Instant::FromNanoseconds(kSecond),
                  end = Instant::FromNanoseconds(4 * kSecond);
    const Hypertrapezoid a = MakeHypertrapezoid(AnyBound(random, 100), start, end);
    const Hypertrapezoid b = MakeHypertrapezoid(AnyBound(random, 100), start, end);
    const double first = FirstOverlap(a, b);
    ASSERT_EQ(first, FirstOverlap(b, a));
    for (int sample = 0; sample <= 16; ++sample) {
      const Exact fraction = Exact(sample) / 16;
      if (fraction * 3 < Exact(std::min(first, 4.0))) {
        ASSERT_GT(LargestGap(a, b, fraction), 0);
      }
    }
    if (first == numeric::kInfinity) continue;
    ++overlaps;
    late_overlaps += first > 0;
    if (first > 0) {
      ASSERT_GE(LargestGap(a, b, Exact(first) / 3), 0) << "overlapped before";
    }
    const Exact soon = Exact(std::min(3.0, first * (1 + 1e-12) + 1e-12)) / 3;
    ASSERT_LE(LargestGap(a, b, soon), Exact(1e-9));
  }
  EXPECT_GT(overlaps, 400);
  EXPECT_GT(late_overlaps, 100);
}

// Goal:   a direction counts only if it holds over the whole window.
TEST(Hypertrapezoid, DirectionThatEndsInsideDoesNotCount) {
  SpaceTimeBound bound;
  bound.limits.acceleration_max = 2;
  bound.state.direction = {1, 0, 0};
  bound.state.direction_until = Instant::FromNanoseconds(2 * kSecond);
  const Instant end = Instant::FromNanoseconds(2 * kSecond);
  EXPECT_EQ(MakeHypertrapezoid(bound, Instant(), end).lower_end[0], 0);
  EXPECT_EQ(MakeHypertrapezoid(bound, Instant(), numeric::AddRoundedUp(end, 1)).lower_end[0], -9);
}

}  // namespace
}  // namespace collision::motion
