// The canonical pair routine against exact arithmetic, a million pairs a run: the judge of the
// tests beside it.
//
// Never late: no first overlap before the answer. Each stretch is proved free either cheaply, by
// positive Bernstein coefficients in exact dyadic numbers, or where those do not decide by Sturm's
// theorem; boxes by the exact signs of quadratics at each other's roots, with a jerk by negative
// Bernstein coefficients on ever smaller stretches. No sign is sampled.
// Not idle: by the answer and 1e-9 of it all tests have met; where not, then with reaches larger by
// a stated share of what they are compared with, a few units in the last place.
//
// COLLISION_ORACLE_PAIRS=N asks for N pairs in all.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact_meeting.h"

namespace collision::intersection {

/// How many 60ths of all pairs a distribution has: boxes take longer to judge.
inline constexpr int kParts = 60, kPartsOfBalls = 4, kPartsOfBoxes = 1;

inline constexpr std::int64_t kSecond = 1'000'000'000;

inline long PairsInAll() {
  if (const char* asked = std::getenv("COLLISION_ORACLE_PAIRS")) return std::atol(asked);
  return kSanitized ? 20'000 : 1'000'000;
}

struct Pair {
  motion::SpaceTimeBound a, b;
  Instant from;
};

/// How early the answers were, from "not at all" on.
class Tally {
 public:
  enum Grade { kNever, kUlps, kTiny, kStated, kForced4, kForced16, kForced64, kIdle };

  void Count(Grade grade) { ++counts_[grade]; }
  ProofCounts* proofs() { return &proofs_; }

  void Print() const {
    static const char* const kNames[] = {"never",        "2^-50",         "2^-40",         "1e-9",
                                         "4 ulp forced", "16 ulp forced", "64 ulp forced", "idle"};
    for (int grade = 0; grade < 8; ++grade) {
      if (counts_[grade] == 0) continue;
      std::printf("  %-14s %9llu\n", kNames[grade],
                  static_cast<unsigned long long>(counts_[grade]));
      testing::Test::RecordProperty(kNames[grade], std::to_string(counts_[grade]));
    }
    std::printf("  proved free by Bernstein %llu, by Sturm %llu\n",
                static_cast<unsigned long long>(proofs_.bernstein),
                static_cast<unsigned long long>(proofs_.sturm));
  }

 private:
  std::uint64_t counts_[8] = {};
  ProofCounts proofs_;
};

/// How early a finite answer is.
inline Tally::Grade GradeOf(const Pair& pair, const IntersectionTime& time) {
  const auto ahead = [&](double share) {
    return ExactMeeting::Nanoseconds(time.seconds) * (Dyadic(1) + Dyadic(share));
  };
  const ExactMeeting inner(pair.a, pair.b, time.base, {false, 0});
  if (inner.MetBy(ahead(0x1p-50))) return Tally::kUlps;
  if (inner.MetBy(ahead(0x1p-40))) return Tally::kTiny;
  if (inner.MetBy(ahead(1e-9))) return Tally::kStated;
  const auto forced = [&](double units) {
    const ExactMeeting larger(pair.a, pair.b, time.base, {false, units * 0x1p-52});
    return larger.MetBy(ahead(1e-9));
  };
  if (forced(4)) return Tally::kForced4;
  if (forced(16)) return Tally::kForced16;
  if (forced(64)) return Tally::kForced64;
  return Tally::kIdle;
}

/// Judges one pair; fatal failures name it.
inline void Judge(const Pair& pair, Tally::Grade worst, Tally* tally) {
  const IntersectionTime time = EarliestIntersection(pair.a, pair.b, pair.from);
  const IntersectionTime swapped = EarliestIntersection(pair.b, pair.a, pair.from);
  ASSERT_EQ(time.seconds, swapped.seconds);
  ASSERT_EQ(time.base, std::max({pair.from, pair.a.state.stamp, pair.b.state.stamp}));
  if (NeverMoves(pair.a) && NeverMoves(pair.b)) {
    ASSERT_EQ(time.seconds, numeric::kInfinity);
    return tally->Count(Tally::kNever);
  }
  const Instant expiry = std::min(pair.a.state.expiry, pair.b.state.expiry);
  std::optional<Dyadic> end;
  if (!expiry.is_never()) end = ExactMeeting::Between(time.base, expiry);
  const ExactMeeting outer(pair.a, pair.b, time.base, {true, 0});
  if (std::isinf(time.seconds)) {
    ASSERT_TRUE(outer.FreeBefore(end, tally->proofs())) << "never is too late";
    return tally->Count(Tally::kNever);
  }
  const Dyadic x = ExactMeeting::Nanoseconds(time.seconds);
  ASSERT_TRUE(!end || x < *end) << "after the expiry: " << time.seconds;
  ASSERT_TRUE(outer.FreeBefore(x, tally->proofs())) << "late: " << time.seconds;
  const Tally::Grade grade = GradeOf(pair, time);
  ASSERT_LE(grade, worst) << "idle: " << time.seconds;
  tally->Count(grade);
}

/// Judges pairs from a distribution: none late, none earlier than `worst` says.
template <typename Draw>
inline void JudgeAll(std::uint64_t seed, Tally::Grade worst, Draw draw, int parts = kPartsOfBalls) {
  DyadicPool::Install();
  Random random(seed);
  Tally tally;
  const long pairs = (PairsInAll() * parts + kParts - 1) / kParts;
  for (long i = 0; i < pairs; ++i) {
    Judge(draw(random), worst, &tally);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "pair " << i;
  }
  tally.Print();
}

inline motion::SpaceTimeBound Ball(const Eigen::Vector3d& p, const Eigen::Vector3d& v,
                                   double radius, double acceleration_max = 0) {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

inline double Any(Random& random) { return random.LogUniform(1e-12, 1e12); }

inline double AnyOrZero(Random& random) { return random.Chance(0.2) ? 0 : Any(random); }

inline Instant Stamp(Random& random, std::int64_t range) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(range)));
}

/// Every quantity of any magnitude.
inline motion::SpaceTimeBound AnyAgent(Random& random) {
  motion::SpaceTimeBound bound =
      Ball(Any(random) * random.UnitVector(), AnyOrZero(random) * random.UnitVector(),
           AnyOrZero(random), AnyOrZero(random));
  if (random.Chance(0.3)) bound.state.stamp = Stamp(random, kSecond);
  if (random.Chance(0.2)) bound.limits.time_step = random.LogUniform(1e-6, 1);
  if (random.Chance(0.2)) bound.state.position_error = Any(random);
  if (random.Chance(0.2)) bound.state.velocity_error = Any(random);
  return bound;
}

/// Comparable quantities, so that meetings are likely.
inline motion::SpaceTimeBound NearbyAgent(Random& random, const Eigen::Vector3d& offset) {
  motion::SpaceTimeBound bound =
      Ball(offset + 100 * random.Uniform(0, 1) * random.UnitVector(),
           random.LogUniform(0.1, 100) * random.UnitVector(), random.Uniform(0, 10),
           random.Chance(0.3) ? 0 : random.Uniform(0, 1));
  bound.state.stamp = Stamp(random, kSecond);
  return bound;
}

/// Declares a direction, mostly one that ends.
inline void AddDirection(Random& random, motion::SpaceTimeBound* bound) {
  bound->state.direction = random.UnitVector();
  if (random.Chance(0.2)) bound->state.direction = {random.Chance(0.5) ? 1.0 : -1.0, 0, 0};
  if (random.Chance(0.8)) bound->state.direction_until = Stamp(random, 15 * kSecond);
  if (random.Chance(0.2)) bound->state.expiry = Stamp(random, 15 * kSecond);
}

}  // namespace collision::intersection
