// Goal:   the earliest intersection of all is, bit for bit, the one computed from scratch, also
//         where a cached bound was computed at an earlier time.
// Method: pairs of the same geometry, turned at random, so that all meet at the same time up to
//         rounding and the canonical routine's earliness, which differs for each start time; every
//         pair computed anew beside it. No new states: only time passes.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "collision_core/intersection/earliest_intersection.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

/// How the two of each pair come near each other: both alike, each half of the way.
struct Approach {
  double gap = 0;    ///< Of the centres, along the way [m].
  double aside = 0;  ///< And across it [m].
  double speed = 0;  ///< Of each [m/s].
  double acceleration_max = 0;
  double offset = 0;  ///< Of all from the origin [m].

  /// No two meet before [s].
  double Duration() const {
    const double by_speed = speed > 0 ? gap / (2 * speed) : 1e300;
    const double by_force = acceleration_max > 0 ? std::sqrt(gap / acceleration_max) : 1e300;
    return std::min(by_speed, by_force) / 2;
  }
};

/// Each agent has one state.
class Pairs {
 public:
  Pairs(const Approach& approach, double announce_within, std::uint64_t seed) : random_(seed) {
    DetectorOptions options;
    options.announce_within = announce_within;
    detector_.emplace(options);
    for (int pair = 0; pair < 5; ++pair) Add(pair, approach);
  }

  void ExpectAsFromScratch(double t) {
    detector_->Advance(At(t));
    EarliestAnswer scratch;
    for (std::uint32_t a = 0; a < bounds_.size(); ++a) {
      for (std::uint32_t b = a + 1; b < bounds_.size(); ++b) {
        const Instant when =
            intersection::EarliestIntersection(bounds_[a], bounds_[b], At(t)).instant();
        if (when < scratch.earliest) scratch = {true, when, Id(a), Id(b)};
      }
    }
    const EarliestAnswer lazy = detector_->Earliest();
    EXPECT_EQ(lazy.earliest, scratch.earliest) << "at " << t;
    EXPECT_EQ(lazy.lower, scratch.lower) << "at " << t;
    EXPECT_EQ(lazy.higher, scratch.higher) << "at " << t;
  }

  std::size_t tracked() const { return detector_->pairs_tracked(); }

 private:
  void Add(int pair, const Approach& approach) {
    const Vector3d middle =
        random_.UnitVector() * approach.offset + Vector3d(5 * approach.gap, 0, 0) * pair;
    const Vector3d n = random_.UnitVector();
    const Vector3d across = n.cross(random_.UnitVector()).normalized() * approach.aside;
    for (const double side : {-0.5, 0.5}) {
      const motion::MotionState state =
          State(0, middle + side * (n * approach.gap + across), -2 * side * approach.speed * n);
      const AgentDeclaration declaration{
          .limits = {.radius = 1, .acceleration_max = approach.acceleration_max}};
      detector_->Admit(Id(static_cast<std::uint32_t>(bounds_.size())), declaration, state, At(0));
      bounds_.push_back({state, declaration.limits, 0});
    }
  }

  Random random_;
  std::optional<Detector> detector_;
  std::vector<motion::SpaceTimeBound> bounds_;
};

void ExpectLazyIsScratch(const Approach& approach, std::uint64_t seed) {
  // Known by their agents' keys; known as tracked pairs, by what each can add at the earliest.
  for (const double announce_within : {1.0 / 60, 1e9}) {
    SCOPED_TRACE(testing::Message()
                 << "announced " << announce_within << " s before, seed " << seed);
    Pairs pairs(approach, announce_within, seed);
    for (int step = 0; step < 20; ++step) {
      pairs.ExpectAsFromScratch(step * approach.Duration() / 20);
    }
    if (announce_within < 1) {
      EXPECT_EQ(pairs.tracked(), 0u);
    }
    if (testing::Test::HasFailure()) return;
  }
}

// Near the origin and slow, so that the earliness is more than the margin of the bounds explains.
TEST(Earliest, EarlinessGrowsWithTheWay) {
  Random random(5);
  for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed) {
    ExpectLazyIsScratch(
        {.gap = random.LogUniform(10, 1000),
         .aside = random.Chance(0.3) ? 0 : random.LogUniform(0.01, 100),
         .speed = random.LogUniform(1e-6, 1),
         .acceleration_max = random.Chance(0.3) ? 0 : random.LogUniform(1e-14, 1e-3)},
        seed);
  }
}

// Those that just touch in passing, or just not: rounding decides whether they meet at all.
TEST(Earliest, GrazingIsDecidedAnewAtEachTime) {
  Random random(6);
  for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed) {
    Approach approach{.gap = random.LogUniform(10, 1000), .speed = random.LogUniform(1e-3, 100)};
    if (random.Chance(0.5)) approach.offset = random.LogUniform(1, 1e9);
    approach.aside = 2 + 0x1p-53 * (approach.gap + approach.offset) * random.Uniform(-4, 4);
    ExpectLazyIsScratch(approach, seed);
  }
}

// Far from the origin a slow agent's states are off by a unit in the last place, much more than it
// moves in a nanosecond. The margin of the bounds lasts for thousands of them: no agent is queried
// anew.
TEST(Earliest, RoundingOfManyStatesIsNoNews) {
  Detector detector{DetectorOptions{}};
  const AgentDeclaration slow{.limits = {.radius = 1, .acceleration_max = 1e-6}};
  const Vector3d v(1e-3, 2e-3, 0);
  const Vector3d places[] = {{1e8, 3e7, 0}, {1e8, 3.1e7, 0}};
  for (int step = 0; step < 2000; ++step) {
    const double t = step / 16.0;
    for (const std::uint32_t slot : {0u, 1u}) {
      const motion::MotionState state = State(t, places[slot] + v * t, v);
      if (step == 0) {
        detector.Admit(Id(slot), slow, state, At(0));
      } else {
        EXPECT_EQ(detector.Update(Id(slot), state, At(t)), UpdateOutcome::kKept);
      }
    }
    detector.Advance(At(t));
  }
  EXPECT_EQ(detector.counters().queries, 2u);
}

// So near the end of time that there is no instant announce_within later: no agent is due for ever.
TEST(Earliest, TheEndOfTimeIsReached) {
  Detector detector{{.announce_within = 1e9}};
  for (const std::uint32_t slot : {0u, 1u}) {
    detector.Admit(Id(slot), {.limits = {.radius = 1}}, State(0, {3.0 * slot, 0, 0}, {1, 0, 0}),
                   At(0));
  }
  detector.Advance(At(0));
  detector.Advance(At(9e9));
  EXPECT_FALSE(detector.Earliest().found);
}

}  // namespace
}  // namespace collision::detection
