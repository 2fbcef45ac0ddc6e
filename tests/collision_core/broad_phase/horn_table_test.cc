// Goal:   the filter between two horns never rules out what the canonical routine answers, and
//         rules out most of what comes later.
// Method: pairs of all scales, stamps before and after the query's begin; beside the canonical
//         answer, whose own error is at most a relative 1e-9.
#include "collision_core/broad_phase/filter/horn_table.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kPairs = kSanitized ? 4000 : 200000;

constexpr Instant kStart = Instant::FromNanoseconds(5'000'000'000'000);

motion::SpaceTimeBound Draw(double size, double time, Random* random) {
  motion::SpaceTimeBound bound;
  const double speed = random->Chance(0.2) ? 0 : size / time * random->LogUniform(1e-3, 1e3);
  bound.state.stamp =
      numeric::AddRoundedUp(kStart, random->Chance(0.5) ? 0 : time * random->Uniform(-2, 0.5));
  bound.state.p_WA = random->UnitVector() * (size * random->Uniform(0, 10));
  if (random->Chance(0.2)) bound.state.p_WA.array() += size * random->LogUniform(1, 1e9);
  bound.state.v_WA = random->UnitVector() * speed;
  bound.limits.radius = random->Chance(0.2) ? 0 : size * random->LogUniform(1e-6, 1);
  bound.limits.acceleration_max =
      random->Chance(0.3) ? 0 : size / (time * time) * random->LogUniform(1e-4, 1e4);
  if (random->Chance(0.3)) {
    bound.limits.time_step = 0.01 * time;
    bound.state.position_error = 0.01 * size;
    bound.state.velocity_error = 0.01 * speed;
    bound.skew = 0.02 * time;
  }
  return bound;
}

TEST(HornTable, TheFilterIsNeverLaterThanTheCanonicalAnswer) {
  int found = 0, tight = 0;
  for (int pair = 0; pair < kPairs; ++pair) {
    Random random(pair);
    const double size = random.LogUniform(1e-9, 1e9), time = random.LogUniform(1e-3, 1e3);
    HornTable table;
    table.Set(0, Draw(size, time, &random));
    motion::SpaceTimeBound other = Draw(size, time, &random);
    // Near each other also where both are far from the origin.
    if (random.Chance(0.7)) {
      other.state.p_WA =
          table.bound(0).state.p_WA + random.UnitVector() * size * random.Uniform(0, 10);
    }
    table.Set(1, other);
    const Instant answer =
        intersection::EarliestIntersection(table.bound(0), table.bound(1), kStart).instant();
    const double bound = table.EarlierBound(0, 1, kStart, numeric::kInfinity);
    if (answer.is_never()) continue;
    ++found;
    const double seconds = numeric::SecondsBetween(kStart, answer).upper + 1e-9;
    ASSERT_LE(bound * (1 - 4e-9), seconds) << "pair " << pair;
    tight += bound >= 0.99 * (seconds - 2e-9);
  }
  EXPECT_GT(found, kPairs / 4);
  EXPECT_GT(tight, found * 3 / 5);
}

TEST(HornTable, CountsItsHorns) {
  HornTable table;
  motion::SpaceTimeBound bound;
  table.Set(3, bound);
  EXPECT_EQ(table.count(), 1u);
  EXPECT_EQ(table.size(), 4u);
  EXPECT_FALSE(table.contains(2));
  bound.limits.radius = 1e30;
  table.Set(3, bound);
  EXPECT_TRUE(table.row(3).unfilterable);
  EXPECT_EQ(table.still_count(), 1u);
  EXPECT_EQ(table.EarlierBound(3, 3, kStart, 1), 0);
  table.Remove(3);
  table.Remove(3);
  EXPECT_EQ(table.count() + table.still_count(), 0u);
}

}  // namespace
}  // namespace collision::broad_phase
