// Goal:   a step's budget is kept, however much the pairs want; a small one widens brackets and
//         makes none wrong, no pair starves, and an event that was cut short says so.
// Method: pairs of ships that all meet at the same known time, under budgets from none to plenty.
#include <gtest/gtest.h>

#include <map>

#include "collision_core/numeric/seconds.h"
#include "collision_core/shape/shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"

namespace collision::detection {
namespace {

constexpr std::uint32_t kPairs = 24;
constexpr std::uint64_t kPerTurn = 40000;

// What has begun is finished: a pose, a point's winding number, the triangles of two leaves.
constexpr std::uint64_t kOverrunOfTurn = 1000;
// The least that a turn is expected to cost.
constexpr std::uint64_t kTurnMin = 1000;

// Arms of 1 m; the second flies at the first at 2 m/s and touches it from 3 s to 5 s.
class Meetings : public Line {
 public:
  explicit Meetings(std::uint64_t per_step) : Line(Options(per_step)) {
    const auto ship = shape::Shape::Build(LShape());
    AgentDeclaration declaration{.limits = {2, 1}};
    declaration.limits.angular_acceleration_max = 0.5;
    declaration.shape = ship;
    for (std::uint32_t i = 0; i < kPairs; ++i) {
      Put(2 * i + 1, declaration, {0, 100.0 * i, 0}, {0, 0, 0});
      Put(2 * i + 2, declaration, {8, 100.0 * i, 0.1}, {-2, 0, 0});
    }
  }

  void Run(double end) {
    while (now < end) {
      const std::uint64_t before = detector.counters().work_units;
      RunTo(now + 1.0 / 16);  // one step
      most = std::max(most, detector.counters().work_units - before);
      waiting = std::max(waiting, detector.pairs_waiting());
    }
  }

  /// The ended contacts by their lower agent.
  std::map<std::uint32_t, CollisionEvent> Ended() const {
    std::map<std::uint32_t, CollisionEvent> ended;
    for (const CollisionEvent& event : With(EventStatus::kEnded)) ended[event.lower.slot] = event;
    return ended;
  }

  std::uint64_t most = 0;   ///< Units in one step.
  std::size_t waiting = 0;  ///< Pairs after one step.

 private:
  static DetectorOptions Options(std::uint64_t per_step) {
    DetectorOptions options;
    options.work_units_per_evaluation = kPerTurn;
    options.work_units_per_step = per_step;
    return options;
  }

  void Put(std::uint32_t slot, const AgentDeclaration& declaration, const Vector3d& p,
           const Vector3d& v) {
    detector.Admit(Id(slot), declaration, State(now, p, v), At(now));
    agents.push_back({slot, p, v, now});
  }
};

double Width(const TimeBracket& bracket) {
  return numeric::SecondsBetween(bracket.earliest, bracket.latest).upper;
}

TEST(StepBudget, IsKept) {
  for (const std::uint64_t budget : {1u, 2000u, 20000u, 100000u}) {
    Meetings meetings(budget);
    meetings.Run(7);
    const std::uint64_t turns = std::min<std::uint64_t>(kPairs, 1 + budget / kTurnMin);
    EXPECT_LE(meetings.most, budget + turns * kOverrunOfTurn) << budget;
    EXPECT_GT(meetings.waiting + meetings.detector.counters().evaluations_cut_short, 0u) << budget;
  }
}

TEST(StepBudget, ThatIsPlentyChangesNothing) {
  Meetings free(0), plenty(kPairs * kPerTurn);
  free.Run(7);
  plenty.Run(7);
  ASSERT_EQ(free.events.size(), plenty.events.size());
  for (std::size_t i = 0; i < free.events.size(); ++i) {
    EXPECT_EQ(free.events[i].lower, plenty.events[i].lower);
    EXPECT_EQ(free.events[i].begin.earliest, plenty.events[i].begin.earliest);
    EXPECT_EQ(free.events[i].begin.latest, plenty.events[i].begin.latest);
    EXPECT_EQ(free.events[i].work, plenty.events[i].work);
  }
  EXPECT_GT(free.most, 100000u) << "the budgets of the test above were tight";
}

TEST(StepBudget, StarvesNoPairAndReportsItsEffect) {
  Meetings free(0), tight(20000);
  free.Run(7);
  tight.Run(7);
  const auto wide = tight.Ended(), narrow = free.Ended();
  ASSERT_EQ(narrow.size(), kPairs);
  ASSERT_EQ(wide.size(), kPairs);
  for (const auto& [slot, event] : wide) {
    EXPECT_LE(event.begin.earliest, At(3)) << slot;
    EXPECT_GE(event.begin.latest, At(3)) << slot;
    EXPECT_LE(Width(event.begin), 0.25) << slot;
    if (Width(event.begin) > 1.01 * Width(narrow.at(slot).begin)) {
      EXPECT_EQ(event.limited_by, narrow_phase::BracketLimit::kBudget) << slot;
    }
  }
}

}  // namespace
}  // namespace collision::detection
