// Goal:   the cheap test never spares a partner whose key must be lowered, and spares nearly all
//         others.
// Method: random bounds of every kind, keys about when the canonical routine lets the two meet;
//         with stamps of our days, where a double of all nanoseconds would be off by hundreds of
//         them.
#include "collision_core/detection/clearance/clearance_filter.h"

#include <gtest/gtest.h>

#include "collision_core/detection/agents/bound_margin.h"
#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr std::int64_t kToday = 1'790'000'000'000'000'000;
constexpr int kPairs = 200000;

motion::SpaceTimeBound Draw(double skew, Random* random) {
  motion::SpaceTimeBound bound;
  motion::MotionState& state = bound.state;
  state.stamp =
      Instant::FromNanoseconds(kToday + static_cast<std::int64_t>(random->Below(3'000'000'000)));
  state.p_WA = random->UnitVector() * random->LogUniform(1, 1e4);
  state.v_WA = random->UnitVector() * (random->Chance(0.2) ? 0 : random->LogUniform(0.01, 1e4));
  if (random->Chance(0.3)) state.position_error = random->LogUniform(1e-3, 1);
  if (random->Chance(0.3)) state.velocity_error = random->LogUniform(1e-3, 1);
  if (random->Chance(0.2)) state.discontinuity = true;
  motion::MotionLimits& limits = bound.limits;
  limits.radius = random->LogUniform(0.01, 100);
  limits.acceleration_max = random->Chance(0.3) ? 0 : random->LogUniform(1e-3, 100);
  if (random->Chance(0.3)) limits.time_step = random->LogUniform(1e-3, 0.1);
  bound.skew = skew;
  return BoundMargin(bound).Widen(bound);
}

TEST(ClearanceFilter, CertainlyLaterIsNeverWrong) {
  Random random(11);
  int certain = 0, sparable = 0, lowered = 0;
  for (int i = 0; i < kPairs; ++i) {
    const double skew = random.Chance(0.3) ? 0.01 : 0;
    ClearanceFilter filter(skew);
    const motion::SpaceTimeBound a = Draw(skew, &random), b = Draw(skew, &random);
    filter.Set(AgentIndex(0u), a);
    filter.Set(AgentIndex(1u), b);
    const Instant from = std::max(a.state.stamp, b.state.stamp);
    const Instant meet = intersection::EarliestIntersection(a, b, from).instant();
    // A key a little to either side of their meeting, or anywhere.
    Instant key =
        Instant::FromNanoseconds(kToday + static_cast<std::int64_t>(random.Below(60'000'000'000)));
    if (random.Chance(0.5) && !meet.is_never()) {
      key =
          numeric::AddRoundedDown(meet, (random.Chance(0.5) ? 1 : -1) * random.LogUniform(1e-9, 1));
    }
    const bool later = filter.CertainlyLater(AgentIndex(0u), AgentIndex(1u), key);
    certain += later;
    const double before = meet.is_never()
                              ? numeric::kInfinity
                              : numeric::SecondsBetween(std::max(key, from), meet).lower;
    sparable += before > 1;
    if (key <= from) {
      EXPECT_TRUE(later);
    } else if (later) {
      // The canonical answer is early by up to 1e-9 of the way.
      const double way = meet.is_never() ? 0 : numeric::SecondsBetween(from, meet).upper;
      ASSERT_GE(before, -2e-9 * way - 2e-9) << i;
    }
    lowered += key > meet;
  }
  EXPECT_GT(lowered, kPairs / 10);
  EXPECT_GT(sparable, kPairs / 4);
  EXPECT_GT(certain, sparable * 9 / 10);
}

}  // namespace
}  // namespace collision::detection
