// Goal:   if a state lies ahead of the time up to which its agent is certified free, no clearance
//         promises more than what is certified before that state.
// Method: few agents whose earliest meeting is known in closed form; one of them has a state far
//         ahead, in every way in which a query could miss the time in between.
#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

const AgentDeclaration kSlow{.limits = {.radius = 1, .acceleration_max = 0.01}};

DetectorOptions Options(std::uint32_t pairs_per_agent_max = 256) {
  DetectorOptions options;
  options.announce_within = 0.5;
  options.pairs_per_agent_max = pairs_per_agent_max;
  return options;
}

UpdateOutcome SendState(std::uint32_t slot, const motion::MotionState& state, Detector* detector) {
  const UpdateOutcome outcome = detector->Update(Id(slot), state, state.stamp);
  detector->SetHeardUntil(OwnerOf(Id(slot)), state.stamp);
  return outcome;
}

void ExpectClearUntil(double earliest, double latest, std::uint32_t slot,
                      const Detector& detector) {
  const Instant clear = detector.ClearanceOf(Id(slot))->clear_until;
  EXPECT_GE(clear, At(earliest)) << slot;
  EXPECT_LE(clear, At(latest)) << slot;
}

// It stands where the other one, which has sent no state since, comes by from 1.9 to 2.1 s.
TEST(StateAhead, OneWhoseStateIsOlderStillCounts) {
  Detector detector(Options());
  detector.Admit(Id(0), kSlow, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(1), kSlow, State(0, {-40, 0, 0}, {20, 0, 0}), At(0));
  detector.Advance(At(0));
  EXPECT_EQ(SendState(0, State(2.2, {0, 0, 0}, {0, 0, 0}), &detector), UpdateOutcome::kKept);
  for (const double now : {0.4, 1.0, 1.5}) {
    detector.Advance(At(now));
    for (const std::uint32_t slot : {0u, 1u}) ExpectClearUntil(1.85, 1.9, slot, detector);
  }
  EXPECT_EQ(detector.events().size(), 1u);
}

// One of two agents jumps into the way of the other, whose next state then lies behind it.
void PutInTheWay(Detector* detector) {
  detector->Admit(Id(0), kSlow, State(0, {-20, 0, 0}, {10, 0, 0}), At(0));
  detector->Admit(Id(1), kSlow, State(0, {0, 100, 0}, {0, 0, 0}), At(0));
  detector->Advance(At(0));
  motion::MotionState jumped = State(0.1, {0, 0, 0}, {0, 0, 0});
  jumped.discontinuity = true;
  SendState(1, jumped, detector);
  detector->Advance(At(0.1));
}

void ExpectTold(double now, Detector* detector) {
  detector->Advance(At(now));
  for (const std::uint32_t slot : {0u, 1u}) ExpectClearUntil(1.75, 1.8, slot, *detector);
}

TEST(StateAhead, ThatPromisesLess) {
  Detector detector(Options());
  PutInTheWay(&detector);
  motion::MotionState state = State(5, {30, 0, 0}, {10, 0, 0});
  state.position_error = 0.5;
  EXPECT_EQ(SendState(0, state, &detector), UpdateOutcome::kWidened);
  for (const double now : {0.4, 1.0, 1.7}) ExpectTold(now, &detector);
}

TEST(StateAhead, AfterAJump) {
  Detector detector(Options());
  PutInTheWay(&detector);
  motion::MotionState state = State(5, {30, 0, 0}, {10, 0, 0});
  state.discontinuity = true;
  EXPECT_EQ(SendState(0, state, &detector), UpdateOutcome::kJumped);
  for (const double now : {0.4, 1.0, 1.7}) ExpectTold(now, &detector);
}

// The agent was queried in the step before.
TEST(StateAhead, BeforeTheEarliestOfAllIsComputed) {
  Detector detector(Options());
  detector.Admit(Id(0), kSlow, State(0, {-20, 0, 0}, {10, 0, 0}), At(0));
  detector.Admit(Id(1), kSlow, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  detector.Advance(At(0));
  motion::MotionState state = State(0.1, {-19, 0, 0}, {10, 0, 0});
  state.position_error = 0.01;
  EXPECT_EQ(SendState(0, state, &detector), UpdateOutcome::kWidened);
  detector.Advance(At(0.1));
  state = State(5, {30, 0, 0}, {10, 0, 0});
  state.position_error = 0.01;
  EXPECT_EQ(SendState(0, state, &detector), UpdateOutcome::kKept);
  EXPECT_LE(detector.Earliest().earliest, At(1.8));
  for (const double now : {0.4, 1.0, 1.7}) ExpectTold(now, &detector);
}

// The agent in the way has no room for pairs, since two others stand about it; its clearance
// promises nothing.
void Crowd(Detector* detector) {
  detector->Admit(Id(1), kSlow, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  detector->Advance(At(0));
  AgentDeclaration about = kSlow, passing = kSlow;
  about.filter.group = 4, about.filter.mask = 1, passing.filter.group = 2;
  detector->Admit(Id(2), about, State(0, {0.1, 0, 0}, {0, 0, 0}), At(0));
  detector->Admit(Id(3), about, State(0, {-0.1, 0, 0}, {0, 0, 0}), At(0));
  detector->Admit(Id(0), passing, State(0, {-20, 0, 0}, {10, 0, 0}), At(0));
  detector->Advance(At(0));
  EXPECT_TRUE(detector->ClearanceOf(Id(1))->saturated);
}

TEST(StateAhead, BehindOneThatIsSaturated) {
  Detector detector(Options(1));
  Crowd(&detector);
  EXPECT_EQ(SendState(0, State(5, {30, 0, 0}, {10, 0, 0}), &detector), UpdateOutcome::kKept);
  detector.Advance(At(0.4));
  EXPECT_LE(detector.ClearanceOf(Id(0))->clear_until, At(1.8));
}

// In the step after its state the other agent is queried, but not the agent itself.
TEST(StateAhead, OfOneThatIsSaturated) {
  Detector detector(Options(1));
  Crowd(&detector);
  for (const double now : {0.3, 0.6, 0.9, 1.2, 1.29}) detector.Advance(At(now));
  EXPECT_EQ(SendState(1, State(5, {0, 0, 0}, {0, 0, 0}), &detector), UpdateOutcome::kKept);
  for (const double now : {1.3, 1.5, 1.7}) {
    detector.Advance(At(now));
    EXPECT_LE(detector.ClearanceOf(Id(0))->clear_until, At(1.8)) << now;
  }
}

// The agent is queried first, and still has no room; then the other one.
TEST(StateAhead, OfOneThatStaysSaturated) {
  Detector detector(Options(1));
  Crowd(&detector);
  EXPECT_EQ(SendState(1, State(5, {0, 0, 0}, {0, 0, 0}), &detector), UpdateOutcome::kKept);
  for (const double now : {0.1, 0.2, 0.3, 0.5, 0.9, 1.3, 1.5, 1.7}) {
    detector.Advance(At(now));
    EXPECT_LE(detector.ClearanceOf(Id(0))->clear_until, At(1.8)) << now;
  }
}

}  // namespace
}  // namespace collision::detection
