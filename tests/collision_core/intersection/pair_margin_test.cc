// Goal:   with a margin two agents meet exactly where they come within it of each other: never
//         late, not idle, the same bits in either order, and no margin changes nothing.
// Method: the exact oracle of the pair routine. It knows no margins, but a position error grows the
//         ball and every face by as much, and takes part in nothing else.
#include <gtest/gtest.h>

#include "collision_core/intersection/intersection_query.h"
#include "collision_core/intersection/pair_rules.h"
#include "collision_core/motion/hypertrapezoid.h"
#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact.h"
#include "tests/support/truth/exact_meeting.h"

namespace collision::intersection {
namespace {

constexpr int kPairs = kSanitized ? 300 : 20000;

constexpr Instant kFrom = Instant::FromNanoseconds(1'000'000'000);

struct Pair {
  motion::SpaceTimeBound a, b;
  double margin;
};

motion::SpaceTimeBound Draw(double size, Random* random) {
  motion::SpaceTimeBound bound;
  bound.state.stamp =
      Instant::FromNanoseconds(static_cast<std::int64_t>(random->Below(kFrom.nanoseconds())));
  bound.state.p_WA = 10 * size * random->Uniform(0, 1) * random->UnitVector();
  bound.state.v_WA = size * random->LogUniform(1e-3, 10) * random->UnitVector();
  bound.limits.radius = random->Chance(0.2) ? 0 : size * random->Uniform(0, 1);
  if (random->Chance(0.7)) bound.limits.acceleration_max = size * random->LogUniform(1e-3, 10);
  if (random->Chance(0.2)) bound.state.velocity_error = 0.01 * size;
  if (random->Chance(0.2)) bound.limits.time_step = 0.01;
  return bound;
}

/// Radii, and margins of all magnitudes beside them; some with directions and caps.
Pair DrawPair(bool boxes, Random* random) {
  const double size = random->LogUniform(1e-9, 1e9);
  Pair pair{Draw(size, random), Draw(size, random), size * random->LogUniform(1e-12, 1e2)};
  for (motion::SpaceTimeBound* bound : {&pair.a, &pair.b}) {
    if (!boxes || random->Chance(0.3)) continue;
    if (random->Chance(0.5)) bound->state.direction = random->UnitVector();
    if (random->Chance(0.5)) bound->limits.speed_max = 1.5 * bound->state.v_WA.norm();
  }
  return pair;
}

IntersectionTime TimeOf(const Pair& pair) {
  return EarliestIntersection(pair.a, pair.b, kFrom, Instant::Never(), pair.margin);
}

void Judge(const Pair& pair, int* met) {
  const IntersectionTime time = TimeOf(pair);
  ASSERT_EQ(time.seconds, TimeOf({pair.b, pair.a, pair.margin}).seconds);
  motion::SpaceTimeBound grown = pair.a;
  grown.state.position_error = pair.margin;
  ProofCounts counts;
  const ExactMeeting outer(grown, pair.b, time.base, {true, 0});
  if (time.seconds == numeric::kInfinity) {
    ASSERT_TRUE(outer.FreeBefore(std::nullopt, &counts)) << "never is too late";
    return;
  }
  ++*met;
  ASSERT_TRUE(outer.FreeBefore(ExactMeeting::Nanoseconds(time.seconds), &counts)) << "late";
  const Dyadic ahead = ExactMeeting::Nanoseconds(time.seconds) * (Dyadic(1) + Dyadic(1e-9));
  const ExactMeeting inner(grown, pair.b, time.base, {false, 4 * 0x1p-52});
  ASSERT_TRUE(inner.MetBy(ahead)) << "idle: " << time.seconds;
}

TEST(PairMargin, BallsAreNeitherLateNorIdle) {
  DyadicPool::Install();
  Random random(1);
  int met = 0;
  for (int i = 0; i < kPairs; ++i) {
    Judge(DrawPair(false, &random), &met);
    ASSERT_FALSE(HasFatalFailure()) << "pair " << i;
  }
  EXPECT_GT(met, kPairs / 4);
}

TEST(PairMargin, BoxesAndCapsAreNeitherLateNorIdle) {
  DyadicPool::Install();
  Random random(2);
  int met = 0;
  for (int i = 0; i < kPairs / 10; ++i) {
    Judge(DrawPair(true, &random), &met);
    ASSERT_FALSE(HasFatalFailure()) << "pair " << i;
  }
  EXPECT_GT(met, kPairs / 40);
}

// Goal:   without a margin the bits are those of the routine that knows none; a larger one is never
//         later.
TEST(PairMargin, NothingIsNothingAndMoreIsNotLater) {
  Random random(3);
  for (int i = 0; i < kPairs; ++i) {
    Pair pair = DrawPair(i % 4 == 0, &random);
    const double wide = TimeOf(pair).seconds;
    pair.margin = 0;
    const double none = TimeOf(pair).seconds;
    ASSERT_EQ(none, EarliestIntersection(pair.a, pair.b, kFrom).seconds);
    ASSERT_LE(wide, none == numeric::kInfinity ? none : none * (1 + 2e-9)) << i;
  }
}

// Goal:   far apart, head-on: 12 m between centres, radii 1 and 1, a margin of 2 m, 10 m/s.
TEST(PairMargin, HeadOnIsExact) {
  Pair pair{{}, {}, 2};
  pair.a.state.v_WA = {10, 0, 0};
  pair.b.state.p_WA = {14, 0, 0};
  pair.a.limits.radius = pair.b.limits.radius = 1;
  const IntersectionTime time =
      EarliestIntersection(pair.a, pair.b, Instant(), Instant::Never(), 2);
  EXPECT_LE(time.seconds, 1);
  EXPECT_GE(time.seconds, 1 - 1e-9);
}

/// The first overlap of two boxes with flat faces, `margin` apart at the most on each axis, by
/// exact rationals: as a fraction of the window; nullopt: none.
std::optional<Exact> ExactOverlap(const motion::Hypertrapezoid& a, const motion::Hypertrapezoid& b,
                                  Exact margin) {
  Exact entry = 0, exit = 1;
  const auto meet = [&](const motion::Hypertrapezoid& below, const motion::Hypertrapezoid& above,
                        int axis) {
    const Exact start = Exact(above.lower_start[axis]) - Exact(below.upper_start[axis]) - margin;
    const Exact end = Exact(above.lower_end[axis]) - Exact(below.upper_end[axis]) - margin;
    if (start <= 0 && end <= 0) return;
    if (start > 0 && end > 0) entry = 2;
    if (start > 0 && end <= 0) entry = std::max<Exact>(entry, start / (start - end));
    if (start <= 0 && end > 0) exit = std::min<Exact>(exit, start / (start - end));
  };
  for (int axis = 0; axis < 3; ++axis) {
    meet(a, b, axis);
    meet(b, a, axis);
  }
  if (entry > exit) return std::nullopt;
  return entry;
}

TEST(PairMargin, HypertrapezoidsHaveRoomBetweenThem) {
  Random random(4);
  int met = 0;
  for (int i = 0; i < kPairs; ++i) {
    const Pair pair = DrawPair(i % 4 == 0, &random);
    const Instant until = numeric::AddRoundedUp(kFrom, random.LogUniform(1e-3, 10));
    const BroadQuery query{BoundKind::kHypertrapezoid, kFrom, until};
    const IntersectionTime time = EarliestIntersectionOf(query, pair.a, pair.b, pair.margin);
    ASSERT_EQ(time.seconds, EarliestIntersectionOf(query, pair.b, pair.a, pair.margin).seconds);
    const motion::Hypertrapezoid a = MakeHypertrapezoid(pair.a, kFrom, until);
    const motion::Hypertrapezoid b = MakeHypertrapezoid(pair.b, kFrom, until);
    const auto exact = ExactOverlap(a, b, pair.margin);
    const Exact window = ExactSeconds(kFrom, until);
    if (exact) {
      ++met;
      ASSERT_LE(time.seconds, numeric::kInfinity);
      ASSERT_TRUE(Exact(time.seconds) <= *exact * window) << "late: pair " << i;
    }
    // Not idle: with 2^-46 of the magnitudes more room they meet by then.
    if (time.seconds == numeric::kInfinity) continue;
    double scale = pair.margin;
    for (const motion::Hypertrapezoid& h : {a, b}) {
      for (int axis = 0; axis < 3; ++axis) {
        scale = std::max({scale, std::abs(h.lower_start[axis]), std::abs(h.upper_end[axis]),
                          std::abs(h.lower_end[axis]), std::abs(h.upper_start[axis])});
      }
    }
    const auto later = ExactOverlap(a, b, Exact(pair.margin) + Exact(scale) * Exact(0x1p-46));
    ASSERT_TRUE(later) << "idle: pair " << i;
    ASSERT_TRUE(Exact(time.seconds * (1 + 1e-9)) >= *later * window) << "idle: pair " << i;
  }
  EXPECT_GT(met, kPairs / 10);
}

}  // namespace
}  // namespace collision::intersection
