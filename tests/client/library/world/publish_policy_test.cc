// Goal:   a staged state is due exactly when the service needs it.
// Method: one agent that drifts at 1 m/s within its bounds; clock and clearances by hand.
#include "client/library/world/publish_policy.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace collision::client {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint32_t kRevision = 1;

State DriftingAt(std::int64_t stamp_ns) {
  return {.stamp_ns = stamp_ns,
          .position_m = {1e-9 * static_cast<double>(stamp_ns), 0, 0},
          .velocity_m_s = {1, 0, 0}};
}

class OutgoingStatesTest : public testing::Test {
 protected:
  void Stage(const State& state) { states_.Stage(state, {.acceleration_max_m_s2 = 1}, policy_); }

  /// Sends the staged state as number `sequence`.
  void Send(std::uint64_t sequence) {
    --sequence;
    states_.MarkSent(&sequence, kRevision);
  }

  std::vector<std::uint64_t> Carried() const {
    std::vector<std::uint64_t> sequences;
    for (const OutgoingStates::Carried& one : states_.carried()) sequences.push_back(one.sequence);
    return sequences;
  }

  /// The service wants a state at `wanted_ns`, and has taken the states up to `acknowledged`.
  void Answer(std::int64_t wanted_ns, std::uint64_t acknowledged) {
    Clearance clearance;
    clearance.clear_until_ns = 10 * kSecond;
    clearance.state_wanted_ns = wanted_ns;
    states_.SetClearance(clearance, acknowledged, 0);
  }

  bool IsDue(std::int64_t clock_ns) const { return states_.IsDue(clock_ns, kRevision, policy_); }

  PublishPolicy policy_{.on_demand = true, .chunk_size = 1};
  OutgoingStates states_;
};

TEST_F(OutgoingStatesTest, TheFirstStateIsDueAtItsStamp) {
  Stage(DriftingAt(kSecond));
  EXPECT_FALSE(IsDue(kSecond - 1));
  EXPECT_TRUE(IsDue(kSecond));
}

// With a period of a second the next state comes at 2 s, in time for 5 s; with one of three seconds
// it comes at 7 s, too late.
TEST_F(OutgoingStatesTest, AStateIsDueIfTheNextOneComesAfterTheWantedTime) {
  Stage(DriftingAt(0));
  Send(1);
  Answer(5 * kSecond, 1);
  Stage(DriftingAt(kSecond));
  EXPECT_FALSE(IsDue(kSecond));
  Stage(DriftingAt(4 * kSecond));
  EXPECT_TRUE(IsDue(4 * kSecond));
}

TEST_F(OutgoingStatesTest, AStateOutsideThePromiseIsDueAtOnce) {
  Stage(DriftingAt(0));
  Send(1);
  Answer(kNever, 1);
  State state = DriftingAt(kSecond);
  EXPECT_FALSE((Stage(state), IsDue(kSecond)));
  state.position_m[0] += 0.6;  // ½ M s² is 0.5 m.
  EXPECT_TRUE((Stage(state), IsDue(kSecond)));
}

TEST_F(OutgoingStatesTest, JumpsAreCarriedUntilTheyAreAcknowledged) {
  Stage(DriftingAt(0));
  Send(1);
  Answer(kNever, 1);
  for (std::uint64_t sequence = 2; sequence <= 5; ++sequence) {
    State state = DriftingAt(static_cast<std::int64_t>(sequence) * kSecond);
    state.discontinuity = sequence != 3;
    Stage(state);
    Send(sequence);
  }
  EXPECT_EQ(Carried(), (std::vector<std::uint64_t>{2, 4}));
  Answer(kNever, 3);
  EXPECT_EQ(Carried(), std::vector<std::uint64_t>{4});
  Answer(kNever, 5);
  Stage(DriftingAt(6 * kSecond));
  Send(6);
  EXPECT_EQ(Carried(), std::vector<std::uint64_t>{});
}

TEST_F(OutgoingStatesTest, OfMoreStatesThanTheBoundTheNewestAreCarried) {
  for (std::uint64_t sequence = 1; sequence <= 100; ++sequence) {
    State jump = DriftingAt(static_cast<std::int64_t>(sequence) * kSecond);
    jump.discontinuity = true;
    Stage(jump);
    Send(sequence);
  }
  ASSERT_EQ(states_.carried().size(), kCarriedMax);
  EXPECT_EQ(states_.carried()[0].sequence, 1u) << "where it begins";
  EXPECT_EQ(states_.carried()[1].sequence, 101 - kCarriedMax);
  EXPECT_FALSE(states_.carried()[1].state.discontinuity) << "what lies before it is not known";
  EXPECT_TRUE(states_.carried()[2].state.discontinuity);
  EXPECT_EQ(states_.carried().back().sequence, 99u);
}

// What it met before the state that arrives could not be told.
TEST_F(OutgoingStatesTest, TheFirstStateIsCarriedUntilItIsAcknowledgedUnlessItIsCorrected) {
  Stage(DriftingAt(kSecond));
  Send(1);
  State corrected = DriftingAt(kSecond);
  corrected.position_m[1] = 100;
  Stage(corrected);
  Send(2);
  EXPECT_EQ(Carried(), std::vector<std::uint64_t>{});
  for (std::uint64_t sequence = 3; sequence <= 5; ++sequence) {
    State state = DriftingAt(static_cast<std::int64_t>(sequence) * kSecond);
    state.position_m[1] = 100;
    Stage(state);
    Send(sequence);
  }
  EXPECT_EQ(Carried(), std::vector<std::uint64_t>{2});
  Answer(kNever, 2);
  EXPECT_EQ(Carried(), std::vector<std::uint64_t>{});
}

// At 2 s it is 100 m away, and at 3 s it has returned.
TEST_F(OutgoingStatesTest, BothEndsOfAMotionThatBreaksTheBoundsAreCarried) {
  for (std::uint64_t sequence = 1; sequence <= 5; ++sequence) {
    State state = DriftingAt(static_cast<std::int64_t>(sequence) * kSecond);
    if (sequence == 3) state.position_m[1] = 100;
    Stage(state);
    Send(sequence);
    if (sequence == 1) Answer(kNever, 1);
  }
  EXPECT_EQ(Carried(), (std::vector<std::uint64_t>{2, 3, 4}));
  Answer(kNever, 3);
  EXPECT_EQ(Carried(), std::vector<std::uint64_t>{4});
}

// The state sent stands in for each of the three that follow: they are in its promise, which is
// wide by then. The third cannot be where it is if the second was where it was.
TEST_F(OutgoingStatesTest, StatesThatBelieTheOneBeforeAreSentWithTheNext) {
  Stage(DriftingAt(0));
  Send(1);
  Answer(kNever, 1);
  Stage(DriftingAt(8 * kSecond));
  EXPECT_FALSE(IsDue(8 * kSecond));
  State away = DriftingAt(9 * kSecond);
  away.position_m[1] = 10;
  Stage(away);
  EXPECT_TRUE(IsDue(9 * kSecond));
  Stage(DriftingAt(10 * kSecond));
  EXPECT_TRUE(IsDue(10 * kSecond));
  std::uint64_t sequence = 1;
  states_.MarkSent(&sequence, kRevision);
  EXPECT_EQ(sequence, 4u);
  EXPECT_EQ(Carried(), (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(states_.carried()[0].state.stamp_ns, 8 * kSecond);
  EXPECT_EQ(states_.carried()[1].state.position_m, away.position_m);
  EXPECT_EQ(states_.sent()->stamp_ns, 10 * kSecond);
}

// The jump at 2 s is told by itself: with the state at 3 s, which does not follow from it, it could
// not be told that.
TEST_F(OutgoingStatesTest, AJumpThatIsBeliedAtOnceStaysAJump) {
  Stage(DriftingAt(kSecond));
  Send(1);
  Answer(kNever, 1);
  State jump = DriftingAt(2 * kSecond);
  jump.position_m[1] = 100;
  jump.discontinuity = true;
  Stage(jump);
  Stage(DriftingAt(3 * kSecond));
  EXPECT_TRUE(states_.StagedJumps());
  EXPECT_FALSE(states_.staged()->discontinuity);
  std::uint64_t sequence = 1;
  states_.MarkSent(&sequence, kRevision);
  EXPECT_EQ(Carried(), std::vector<std::uint64_t>{2});
  EXPECT_TRUE(states_.carried()[0].state.discontinuity);
  EXPECT_EQ(states_.JumpOnItsWay(3 * kSecond), 2 * kSecond);
}

TEST_F(OutgoingStatesTest, AStampBeforeTheLastOneSentIsRefused) {
  Stage(DriftingAt(kSecond));
  Send(1);
  EXPECT_THROW(Stage(DriftingAt(kSecond - 1)), std::invalid_argument);
}

}  // namespace
}  // namespace collision::client
