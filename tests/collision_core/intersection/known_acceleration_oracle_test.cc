// The canonical pair routine against exact arithmetic: pairs with known accelerations and jerk.
#include <gtest/gtest.h>

#include "tests/collision_core/intersection/pair_oracle.h"

namespace collision::intersection {
namespace {

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

// Goal:   parabolas that graze: two that brake and turn back at the distance of their radii,
// exactly,
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
