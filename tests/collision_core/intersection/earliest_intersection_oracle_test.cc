// The canonical pair routine against exact arithmetic, a million pairs a run.
//
// Never late: no first overlap before the answer. Each stretch is proved free either cheaply, by
// positive Bernstein coefficients in exact dyadic numbers, or where those do not decide by Sturm's
// theorem; boxes by the exact signs of quadratics at each other's roots, with a jerk by negative
// Bernstein coefficients on ever smaller stretches. No sign is sampled.
// Not idle: by the answer and 1e-9 of it all tests have met; where not, then with reaches larger by
// a stated share of what they are compared with, a few units in the last place.
//
// COLLISION_ORACLE_PAIRS=N asks for N pairs in all.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact_meeting.h"

namespace collision::intersection {
namespace {

/// How many 60ths of all pairs a distribution has: boxes take longer to judge.
constexpr int kParts = 60, kPartsOfBalls = 4, kPartsOfBoxes = 1;

constexpr std::int64_t kSecond = 1'000'000'000;

long PairsInAll() {
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
Tally::Grade GradeOf(const Pair& pair, const IntersectionTime& time) {
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
void Judge(const Pair& pair, Tally::Grade worst, Tally* tally) {
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
void JudgeAll(std::uint64_t seed, Tally::Grade worst, Draw draw, int parts = kPartsOfBalls) {
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

motion::SpaceTimeBound Ball(const Eigen::Vector3d& p, const Eigen::Vector3d& v, double radius,
                            double acceleration_max = 0) {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

double Any(Random& random) { return random.LogUniform(1e-12, 1e12); }

double AnyOrZero(Random& random) { return random.Chance(0.2) ? 0 : Any(random); }

Instant Stamp(Random& random, std::int64_t range) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(range)));
}

/// Every quantity of any magnitude.
motion::SpaceTimeBound AnyAgent(Random& random) {
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
motion::SpaceTimeBound NearbyAgent(Random& random, const Eigen::Vector3d& offset) {
  motion::SpaceTimeBound bound =
      Ball(offset + 100 * random.Uniform(0, 1) * random.UnitVector(),
           random.LogUniform(0.1, 100) * random.UnitVector(), random.Uniform(0, 10),
           random.Chance(0.3) ? 0 : random.Uniform(0, 1));
  bound.state.stamp = Stamp(random, kSecond);
  return bound;
}

// Goal:   never late and not idle, over 24 orders of magnitude of everything.
TEST(EarliestIntersectionOracle, AllMagnitudes) {
  JudgeAll(101, Tally::kStated, [](Random& random) {
    return Pair{AnyAgent(random), AnyAgent(random), Instant()};
  });
}

// Goal:   likewise far from the origin. Method: up to 1e12 m off, 100 m apart.
TEST(EarliestIntersectionOracle, HugeOffsets) {
  JudgeAll(102, Tally::kStated, [](Random& random) {
    const Eigen::Vector3d offset = AnyOrZero(random) * random.UnitVector();
    return Pair{NearbyAgent(random, offset), NearbyAgent(random, offset),
                Instant::FromNanoseconds(kSecond / 2)};
  });
}

// Goal:   grazing at the distance of the radii: exactly, one unit in the last place more or less,
//         and by 1e-15 to 1e-3. Method: a passage at a right angle, without growth and with.
TEST(EarliestIntersectionOracle, Grazing) {
  JudgeAll(103, Tally::kForced4, [](Random& random) {
    const double scale = Any(random), miss = scale * random.Uniform(0.1, 2);
    const double speed = Any(random), time = random.LogUniform(1e-3, 1e3);
    double radius = miss;
    switch (random.Below(5)) {
      case 0:
        radius = numeric::NextUp(miss);
        break;
      case 1:
        radius = numeric::NextDown(miss);
        break;
      case 2:
        radius = miss * (1 + random.LogUniform(1e-15, 1e-3));
        break;
      case 3:
        radius = miss * (1 - random.LogUniform(1e-15, 1e-3));
        break;
    }
    const double growth = random.Chance(0.5) ? 0 : random.Uniform(0, 0.1) * miss / (time * time);
    return Pair{
        Ball({0, 0, 0}, {0, 0, 0}, std::max(0.0, radius - growth * time * time / 2), growth),
        Ball({-speed * time, miss, 0}, {speed, 0, 0}, 0), Instant()};
  });
}

// Goal:   near triple roots, where distance and reach share value, slope and curvature.
// Method: |d| = √(1 + (δ − c³)²) and S = r + s2 δ², at δ = c + c³, scaled, off by 1e-16 to 1e-2.
TEST(EarliestIntersectionOracle, NearTripleRoots) {
  JudgeAll(104, Tally::kForced4, [](Random& random) {
    const double c = random.Uniform(0.1, 1.4), size = std::sqrt(1 + c * c);
    const double scale = random.LogUniform(1e-6, 1e6), clock = random.LogUniform(1e-3, 1e3);
    double r = (1 - c * c / 2) * size, M = 1 / (size * size * size);
    const auto nudge = [&random](double* x) {
      if (random.Chance(0.3)) return;
      *x *= 1 + random.LogUniform(1e-16, 1e-2) * (random.Chance(0.5) ? 1 : -1);
    };
    nudge(&r);
    nudge(&M);
    return Pair{Ball({0, 0, 0}, {0, 0, 0}, std::max(0.0, r) * scale, M * scale / (clock * clock)),
                Ball({-c * c * c * scale, scale, 0}, {scale / clock, 0, 0}, 0), Instant()};
  });
}

// Goal:   identical agents, the same velocity, the same place, no acceleration: all combinations.
TEST(EarliestIntersectionOracle, Degenerate) {
  JudgeAll(105, Tally::kStated, [](Random& random) {
    Pair pair{AnyAgent(random), AnyAgent(random), Instant()};
    if (random.Chance(0.5)) pair.b.state.p_WA = pair.a.state.p_WA;
    if (random.Chance(0.5)) pair.b.state.v_WA = pair.a.state.v_WA;
    if (random.Chance(0.3)) pair.b.limits = pair.a.limits;
    if (random.Chance(0.2)) pair.b = pair.a;
    if (random.Chance(0.3)) pair.a.limits.acceleration_max = 0;
    if (random.Chance(0.3)) pair.b.limits.acceleration_max = 0;
    if (random.Chance(0.2)) pair.a.limits.radius = pair.b.limits.radius = 0;
    return pair;
  });
}

// Goal:   stamps up to a century apart, and queries long after both.
TEST(EarliestIntersectionOracle, FarApartStamps) {
  JudgeAll(106, Tally::kForced4, [](Random& random) {
    Pair pair{NearbyAgent(random, {0, 0, 0}), NearbyAgent(random, {0, 0, 0}), Instant()};
    const auto stamp = [&random] {
      return Stamp(random, static_cast<std::int64_t>(random.LogUniform(1, 3e18)));
    };
    pair.a.state.stamp = stamp();
    pair.b.state.stamp = stamp();
    pair.from = stamp();
    if (random.Chance(0.7)) {
      // Back to where they are near at the time of the query.
      const Instant base = std::max({pair.from, pair.a.state.stamp, pair.b.state.stamp});
      for (motion::SpaceTimeBound* bound : {&pair.a, &pair.b}) {
        bound->limits.acceleration_max = 0;
        bound->state.p_WA -=
            numeric::SecondsBetween(bound->state.stamp, base).lower * bound->state.v_WA;
      }
    }
    return pair;
  });
}

// Goal:   an expiry just before, at or after the meeting, and within the root's last digits.
TEST(EarliestIntersectionOracle, Expiry) {
  JudgeAll(107, Tally::kStated, [](Random& random) {
    Pair pair{NearbyAgent(random, {0, 0, 0}), NearbyAgent(random, {0, 0, 0}),
              Instant::FromNanoseconds(kSecond)};
    const IntersectionTime time = EarliestIntersection(pair.a, pair.b, pair.from);
    const Instant meeting = std::min(time.instant(), Instant::FromNanoseconds(100 * kSecond));
    const std::int64_t off = static_cast<std::int64_t>(random.Below(5)) - 2;
    const std::int64_t factor = random.Chance(0.5) ? 1 : kSecond / 10;
    (random.Chance(0.5) ? pair.a : pair.b).state.expiry =
        Instant::FromNanoseconds(meeting.nanoseconds() + off * factor);
    return pair;
  });
}

// Goal:   inside, leave, return: asked while they part, they meet again when the horns catch up.
TEST(EarliestIntersectionOracle, InsideLeaveReturn) {
  JudgeAll(108, Tally::kStated, [](Random& random) {
    const double scale = random.LogUniform(1e-6, 1e6), M = random.LogUniform(1e-6, 1e-1);
    Pair pair{Ball({0, 0, 0}, {0, 0, 0}, scale, M * scale),
              Ball(scale * random.Uniform(0, 2) * random.UnitVector(),
                   scale * random.Uniform(1, 10) * random.UnitVector(), scale * 0.1),
              Instant()};
    pair.from = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Uniform(0, 5) * 1e9));
    return pair;
  });
}

// Goal:   overlapping or touching at once: exactly, or by units in the last place.
TEST(EarliestIntersectionOracle, AlreadyThere) {
  JudgeAll(109, Tally::kForced4, [](Random& random) {
    const double scale = Any(random), radius = scale * random.Uniform(0.1, 1);
    // 2² + 3² + 6² = 7².
    const double unit = (radius + scale) / 7;
    Eigen::Vector3d p = unit * Eigen::Vector3d(2, 3, 6);
    if (random.Chance(0.5)) p *= 1 + (random.Uniform(-4, 4) * 0x1p-52);
    if (random.Chance(0.2)) p *= random.Uniform(0.5, 1.1);
    return Pair{Ball({0, 0, 0}, {0, 0, 0}, radius, AnyOrZero(random)),
                Ball(p, AnyOrZero(random) * random.UnitVector(), scale, 0), Instant()};
  });
}

// Goal:   skew, errors and steps widen as documented. Method: |v| κ rounded outward at 2^-300.
TEST(EarliestIntersectionOracle, ErrorsSkewAndStep) {
  JudgeAll(110, Tally::kStated, [](Random& random) {
    const auto agent = [&random] {
      motion::SpaceTimeBound bound = NearbyAgent(random, {0, 0, 0});
      if (random.Chance(0.8)) bound.skew = random.LogUniform(1e-9, 0.5);
      if (random.Chance(0.5)) bound.state.position_error = random.LogUniform(1e-6, 1);
      if (random.Chance(0.5)) bound.state.velocity_error = random.LogUniform(1e-6, 1);
      if (random.Chance(0.5)) bound.limits.time_step = random.LogUniform(1e-4, 1);
      return bound;
    };
    return Pair{agent(), agent(), Instant::FromNanoseconds(kSecond)};
  });
}

/// Declares a direction, mostly one that ends.
void AddDirection(Random& random, motion::SpaceTimeBound* bound) {
  bound->state.direction = random.UnitVector();
  if (random.Chance(0.2)) bound->state.direction = {random.Chance(0.5) ? 1.0 : -1.0, 0, 0};
  if (random.Chance(0.8)) bound->state.direction_until = Stamp(random, 15 * kSecond);
  if (random.Chance(0.2)) bound->state.expiry = Stamp(random, 15 * kSecond);
}

// Goal:   directions and their ends: boxes, piece by piece.
TEST(EarliestIntersectionOracle, Directions) {
  JudgeAll(
      111, Tally::kStated,
      [](Random& random) {
        Pair pair{NearbyAgent(random, {0, 0, 0}), NearbyAgent(random, {0, 0, 0}),
                  Instant::FromNanoseconds(kSecond)};
        for (motion::SpaceTimeBound* bound : {&pair.a, &pair.b}) {
          bound->state.v_WA *= random.Uniform(0, 0.2);
          bound->limits.acceleration_max = random.LogUniform(0.01, 20);
          if (random.Chance(0.3)) bound->skew = random.LogUniform(1e-6, 0.2);
        }
        AddDirection(random, &pair.a);
        if (random.Chance(0.5)) AddDirection(random, &pair.b);
        return pair;
      },
      kPartsOfBoxes);
}

// Goal:   speed caps: reached before or after the meeting, at once, or never; with all the rest.
TEST(EarliestIntersectionOracle, SpeedCaps) {
  JudgeAll(
      112, Tally::kStated,
      [](Random& random) {
        Pair pair{NearbyAgent(random, {0, 0, 0}), NearbyAgent(random, {0, 0, 0}),
                  Instant::FromNanoseconds(kSecond)};
        for (motion::SpaceTimeBound* bound : {&pair.a, &pair.b}) {
          if (random.Chance(0.2)) continue;
          bound->limits.acceleration_max = random.LogUniform(0.01, 100);
          const double speed = bound->state.v_WA.norm();
          bound->limits.speed_max = speed * (1 + random.LogUniform(1e-6, 10));
          if (random.Chance(0.2)) bound->limits.speed_max = speed;
          if (random.Chance(0.2)) bound->skew = random.LogUniform(1e-6, 0.2);
          if (random.Chance(0.2)) bound->limits.time_step = random.LogUniform(1e-4, 0.1);
          if (random.Chance(0.2)) bound->state.velocity_error = random.LogUniform(1e-6, 1);
          if (random.Chance(0.2)) AddDirection(random, bound);
        }
        return pair;
      },
      kPartsOfBoxes);
}

// Goal:   pairs that never meet are recognized. Method: no acceleration, mostly a near miss.
TEST(EarliestIntersectionOracle, NearMisses) {
  JudgeAll(113, Tally::kStated, [](Random& random) {
    const double speed = Any(random), miss = random.Uniform(1, 1.5);
    const Eigen::Vector3d along = random.UnitVector();
    Eigen::Vector3d across = along.cross(random.UnitVector());
    across /= std::max(0.01, across.norm());
    const double scale = Any(random);
    return Pair{Ball({0, 0, 0}, {0, 0, 0}, 0.5 * scale),
                Ball(scale * (miss * across - random.LogUniform(1e-3, 1e6) * along), speed * along,
                     0.5 * scale),
                Instant()};
  });
}

/// Something is known of its acceleration, and something of that ages.
void AddKnowledge(Random& random, double least, double greatest, motion::SpaceTimeBound* bound) {
  const auto some = [&] { return random.LogUniform(least, greatest); };
  if (random.Chance(0.8)) bound->state.a_WA = some() * random.UnitVector();
  if (random.Chance(0.6)) bound->limits.jerk_max = some();
  if (random.Chance(0.5)) bound->limits.acceleration_max = 0;
}

// Goal:   known accelerations and jerk, over 24 orders of magnitude of everything.
TEST(EarliestIntersectionOracle, KnownAccelerationsOfAllMagnitudes) {
  JudgeAll(114, Tally::kForced4, [](Random& random) {
    Pair pair{AnyAgent(random), AnyAgent(random), Instant()};
    for (motion::SpaceTimeBound* bound : {&pair.a, &pair.b}) {
      AddKnowledge(random, 1e-12, 1e12, bound);
    }
    return pair;
  });
}

// Goal:   likewise of comparable quantities, with errors, skew, steps and stamps long past.
TEST(EarliestIntersectionOracle, KnownAccelerationsNearby) {
  JudgeAll(115, Tally::kForced4, [](Random& random) {
    const Eigen::Vector3d offset =
        random.Chance(0.5) ? Eigen::Vector3d(0, 0, 0) : 7e6 * random.UnitVector();
    Pair pair{NearbyAgent(random, offset), NearbyAgent(random, offset),
              Instant::FromNanoseconds(kSecond)};
    for (motion::SpaceTimeBound* bound : {&pair.a, &pair.b}) {
      AddKnowledge(random, 1e-3, 20, bound);
      if (random.Chance(0.3)) bound->skew = random.LogUniform(1e-9, 0.5);
      if (random.Chance(0.3)) bound->state.position_error = random.LogUniform(1e-6, 1);
      if (random.Chance(0.3)) bound->limits.time_step = random.LogUniform(1e-4, 1);
    }
    if (random.Chance(0.3)) pair.from = Stamp(random, 100 * kSecond);
    return pair;
  });
}

// Goal:   parabolas that graze: two that brake and turn back at the distance of their radii, exactly,
//         one unit in the last place more or less, and by 1e-15 to 1e-3; all fall together.
// Method: the gap c (t − t0)² along a line, less what is missing at t0; without growth and with.
TEST(EarliestIntersectionOracle, KnownAccelerationsThatGraze) {
  JudgeAll(116, Tally::kForced16, [](Random& random) {
    const double size = random.LogUniform(1e-3, 1e3), time = random.LogUniform(1e-2, 1e2);
    const double c = size * random.LogUniform(1e-2, 1e2) / (time * time);
    double radius = size;
    switch (random.Below(5)) {
      case 0:
        radius = numeric::NextUp(size);
        break;
      case 1:
        radius = numeric::NextDown(size);
        break;
      case 2:
        radius = size * (1 + random.LogUniform(1e-15, 1e-3));
        break;
      case 3:
        radius = size * (1 - random.LogUniform(1e-15, 1e-3));
        break;
    }
    Pair pair{Ball({0, 0, 0}, {0, 0, 0}, radius),
              Ball({size + c * time * time, 0, 0}, {-2 * c * time, 0, 0}, 0), Instant()};
    pair.b.state.a_WA = {2 * c, 0, 0};
    if (random.Chance(0.5)) {
      const Eigen::Vector3d gravity = 9.8 * random.UnitVector();
      pair.a.state.a_WA += gravity;
      pair.b.state.a_WA += gravity;
    }
    if (random.Chance(0.3)) {
      const double jerk = random.LogUniform(1e-6, 1e-1) * size / (time * time * time);
      pair.a.limits.jerk_max = jerk;
      pair.a.limits.radius = std::max(0.0, radius - jerk * time * time * time / 6);
    }
    return pair;
  });
}

/// Near each other, slow, with something known, and with a direction, a cap or both.
motion::SpaceTimeBound KnownWithBox(Random& random) {
  motion::SpaceTimeBound bound = NearbyAgent(random, {0, 0, 0});
  bound.state.v_WA *= random.Uniform(0, 0.3);
  AddKnowledge(random, 1e-2, 5, &bound);
  if (random.Chance(0.7)) bound.limits.acceleration_max = random.LogUniform(0.01, 10);
  if (random.Chance(0.6)) AddDirection(random, &bound);
  if (random.Chance(0.6)) {
    bound.limits.speed_max = bound.state.v_WA.norm() * (1 + random.LogUniform(1e-6, 10));
  }
  if (random.Chance(0.2)) bound.skew = random.LogUniform(1e-6, 0.2);
  if (random.Chance(0.2)) bound.limits.time_step = random.LogUniform(1e-4, 0.1);
  return bound;
}

// Goal:   directions and speed caps beside known accelerations: boxes whose faces are not convex.
TEST(EarliestIntersectionOracle, KnownAccelerationsWithBoxes) {
  JudgeAll(
      117, Tally::kForced4,
      [](Random& random) {
        Pair pair{KnownWithBox(random), KnownWithBox(random), Instant::FromNanoseconds(kSecond)};
        pair.a.limits.jerk_max = pair.b.limits.jerk_max = 0;
        return pair;
      },
      kPartsOfBoxes);
}

// Goal:   likewise with jerk: faces are cubics.
TEST(EarliestIntersectionOracle, KnownAccelerationsWithCubicBoxes) {
  JudgeAll(
      118, Tally::kForced4,
      [](Random& random) {
        Pair pair{KnownWithBox(random), KnownWithBox(random), Instant::FromNanoseconds(kSecond)};
        pair.a.limits.jerk_max = random.LogUniform(1e-3, 5);
        return pair;
      },
      kPartsOfBoxes);
}

}  // namespace
}  // namespace collision::intersection
