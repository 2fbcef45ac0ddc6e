// The canonical pair routine against exact arithmetic: distributions of pairs without knowledge of
// their accelerations.
#include <gtest/gtest.h>

#include "tests/collision_core/intersection/pair_oracle.h"

namespace collision::intersection {
namespace {

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

}  // namespace
}  // namespace collision::intersection
