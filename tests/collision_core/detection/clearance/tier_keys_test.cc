// Goal:   where an agent has a key for each class of those beside it, none is forgotten.
// Method: agents on a line, whose earliest meetings are known in closed form; those of several
//         classes due in one step, and a state that lies ahead of the calm ones' key only.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

DetectorOptions AnnouncedFor(double seconds) {
  DetectorOptions options;
  options.announce_within = seconds;
  return options;
}

void SendState(std::uint32_t slot, const motion::MotionState& state, Detector* detector) {
  EXPECT_EQ(detector->Update(Id(slot), state, state.stamp), UpdateOutcome::kKept);
  detector->SetHeardUntil(OwnerOf(Id(slot)), state.stamp);
}

// One that never moves between one of M = 1 and one of M = 100 m/s², each of which may touch it 0.6
// s after its state, give or take 5 ms: both are due at once, and then not before 0.65 s.
TEST(TierKeys, EachTierThatIsDueIsQueried) {
  for (const double later : {0.005, -0.005}) {
    const double times[] = {0.6, 0.6 + later}, accelerations[] = {1, 100};
    const double first = std::min(times[0], times[1]);
    Detector detector(AnnouncedFor(0.5));
    detector.Admit(Id(0), {.limits = {.radius = 1}}, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
    Vector3d places[2];
    for (const std::uint32_t k : {0u, 1u}) {
      const double gap = accelerations[k] * times[k] * times[k] / 2;
      places[k] = {k == 0 ? 2 + gap : -2 - gap, 0, 0};
      detector.Admit(Id(1 + k), {.limits = {.radius = 1, .acceleration_max = accelerations[k]}},
                     State(0, places[k], {0, 0, 0}), At(0));
    }
    detector.Advance(At(0));
    EXPECT_LE(detector.ClearanceOf(Id(0))->clear_until, At(first));
    EXPECT_GE(detector.ClearanceOf(Id(0))->clear_until, At(first - 1e-3));
    for (const std::uint32_t k : {0u, 1u}) {
      SendState(1 + k, State(0.05, places[k], {0, 0, 0}), &detector);
    }
    detector.Advance(At(0.11));
    EXPECT_LE(detector.ClearanceOf(Id(0))->clear_until, At(0.05 + first)) << later;
    EXPECT_GE(detector.ClearanceOf(Id(0))->clear_until, At(0.05 + first - 1e-3)) << later;
  }
}

// Two agents meet in 1.9 s; the state of one lies beyond that, and beyond its key for a violent
// agent a kilometre away, which the other cannot meet. The other is queried first, since it had a
// partner near it: its clearance must not cover the time before that state.
TEST(TierKeys, AStateAheadOfTheComparableKeyIsQueried) {
  Detector detector(AnnouncedFor(0.5));
  const AgentDeclaration calm{.limits = {.radius = 1, .acceleration_max = 0.5}};
  detector.Admit(Id(0), calm, State(0, {-20, 0, 0}, {10, 0, 0}), At(0));
  AgentDeclaration other = calm;
  other.filter.mask = 1;
  detector.Admit(Id(1), other, State(0, {1, 0, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(2), calm, State(0, {1, 2.2, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(3), {.limits = {.radius = 1, .acceleration_max = 1000}, .filter = {.group = 2}},
                 State(0, {-20, 1000, 0}, {0, 0, 0}), At(0));
  detector.Advance(At(0));
  SendState(0, State(5, {30, 0, 0}, {10, 0, 0}), &detector);
  detector.Remove(Id(2));
  detector.Advance(At(0.4));
  EXPECT_LE(detector.ClearanceOf(Id(1))->clear_until, At(1.9));
  EXPECT_GE(detector.ClearanceOf(Id(1))->clear_until, At(1.3));
}

// As above, the other way round: the violent agent is queried first. In the same step a new agent
// appears that the agent with the state ahead may meet later.
TEST(TierKeys, AStateAheadIsQueriedThoughAKeyIsLowered) {
  Detector detector(AnnouncedFor(0.5));
  const AgentDeclaration calm{.limits = {.radius = 1, .acceleration_max = 0.5}};
  const AgentDeclaration violent{.limits = {.radius = 1, .acceleration_max = 1000},
                                 .filter = {.group = 2}};
  detector.Admit(Id(0), calm, State(0, {-20, 0, 0}, {10, 0, 0}), At(0));
  detector.Admit(Id(1), violent, State(0, {-20, 1000, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(2), calm, State(0, {-20, 1182, 0}, {0, 0, 0}), At(0));
  detector.Advance(At(0));
  EXPECT_LE(detector.ClearanceOf(Id(1))->clear_until, At(0.61));
  SendState(0, State(5, {30, 0, 0}, {10, 0, 0}), &detector);
  detector.Remove(Id(2));
  AgentDeclaration later = calm;
  later.filter.mask = 1;
  detector.Admit(Id(3), later, State(0.4, {80, 0, 0}, {0, 0, 0}), At(0.4));
  detector.Advance(At(0.4));
  EXPECT_LE(detector.ClearanceOf(Id(1))->clear_until, At(1.42));
  EXPECT_GE(detector.ClearanceOf(Id(1))->clear_until, At(1.3));
}

}  // namespace
}  // namespace collision::detection
