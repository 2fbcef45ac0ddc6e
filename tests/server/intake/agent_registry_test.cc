// Goal:   an agent is in the detector exactly while its description, a state and the time of its
//         simulator are there; every state counts once, by what became of it, and faults reach
//         their sender.
// Method: one simulator in a world without a bus; the test hands over each message.
#include <array>

#include "tests/server/intake/agent_registry_fixture.h"

namespace collision::server {
namespace {

using Reasons = std::vector<v1::RejectionReason>;

/// What comes when: 0 the description, 1 a state, 2 the clock.
class AgentRegistryOrderTest : public AgentRegistryTest,
                               public testing::WithParamInterface<std::array<int, 3>> {};

TEST_P(AgentRegistryOrderTest, AnAgentIsAdmittedWithTheLastOfDescriptionStateAndClock) {
  for (const int step : GetParam()) {
    EXPECT_EQ(detector.agents(), 0u);
    if (step == 0) Describe(0);
    if (step == 1) Take(State(0, 0, 7));
    if (step == 2) SetClock(0);
  }
  EXPECT_EQ(detector.agents(), 1u);
  EXPECT_EQ(counters().admitted, 1u);
  EXPECT_EQ(counters().states_accepted, 1u);
  EXPECT_TRUE(alpha->agents().Find(0)->admitted());
  EXPECT_EQ(alpha->agents().Find(0)->acknowledged_sequence(), 7u);
  EXPECT_TRUE(TakeReasons().empty());
}

INSTANTIATE_TEST_SUITE_P(EveryOrder, AgentRegistryOrderTest,
                         testing::Values(std::array{0, 1, 2}, std::array{0, 2, 1},
                                         std::array{1, 0, 2}, std::array{1, 2, 0},
                                         std::array{2, 0, 1}, std::array{2, 1, 0}));

class AgentRegistryWallTest : public AgentRegistryTest {
 protected:
  AgentRegistryWallTest() : AgentRegistryTest(v1::Clock::REAL_TIME) {}

  /// Says that no agent accelerates any more, `states_sequence` being its newest state.
  void DescribeAsUnaccelerated(std::uint64_t states_sequence) {
    v1::AgentDescription wire = Description("alpha", 0);
    wire.set_revision(2);
    wire.set_acceleration_max_m_s2(0);
    wire.set_states_sequence(states_sequence);
    Describe(wire);
  }
  /// At rest at so many tenths of a second, 4 mm from where it was a tenth before.
  void TakeMoved(int tenths, std::uint64_t sequence) {
    SetTime(tenths * kSecond / 10);
    v1::AgentState state = State(0, world.now().nanoseconds(), sequence);
    state.mutable_position_m()->set_x(0.004 * tenths);
    Take(state);
  }
};

TEST_F(AgentRegistryWallTest, WithAWallClockNoClockIsAwaited) {
  Describe(0);
  Take(State(0, world.now().nanoseconds(), 1));
  EXPECT_EQ(detector.agents(), 1u);
}

TEST_F(AgentRegistryWallTest, AStateFromBeforeANarrowerBoundIsHeldToTheOneBefore) {
  Describe(0);
  TakeMoved(0, 1);
  DescribeAsUnaccelerated(2);
  TakeMoved(1, 2);
  TakeMoved(2, 3);
  EXPECT_EQ(detector.counters().breaches, 0u);
  TakeMoved(3, 4);
  EXPECT_EQ(detector.counters().breaches, 1u) << "from the first state on that came after it";
}

TEST_F(AgentRegistryWallTest, SoIsTheStateWithWhichAnAgentIsAdmitted) {
  Describe(0);
  DescribeAsUnaccelerated(1);
  TakeMoved(0, 1);
  TakeMoved(1, 2);
  EXPECT_EQ(detector.counters().breaches, 0u);
  TakeMoved(2, 3);
  EXPECT_EQ(detector.counters().breaches, 1u);
}

TEST_F(AgentRegistryWallTest, WhereNoStateIsOnItsWayANarrowerBoundHoldsFromTheNextOneOn) {
  Describe(0);
  TakeMoved(0, 1);
  DescribeAsUnaccelerated(1);
  TakeMoved(1, 2);
  EXPECT_EQ(detector.counters().breaches, 0u);
  TakeMoved(2, 3);
  EXPECT_EQ(detector.counters().breaches, 1u);
}

TEST_F(AgentRegistryTest, AStateWithoutADescriptionIsKeptAndReportedOnceItIsOverdue) {
  SetClock(0);
  EXPECT_EQ(registry.NextDue(), std::nullopt);
  Take(State(0, 0, 1));
  Take(State(0, 0, 2));
  EXPECT_EQ(registry.NextDue(), 3 * kSecond);
  SetTime(3 * kSecond - 1);
  registry.ReportUndescribed();
  EXPECT_TRUE(TakeReasons().empty());
  SetTime(3 * kSecond);
  registry.ReportUndescribed();
  registry.ReportUndescribed();
  EXPECT_EQ(TakeReasons(), Reasons{v1::REJECTED_NOT_DESCRIBED});
  Describe(0);
  EXPECT_EQ(detector.agents(), 1u);
  EXPECT_EQ(alpha->agents().Find(0)->acknowledged_sequence(), 2u) << "the newest state";
}

// It waits for the clock of its simulator.
TEST_F(AgentRegistryTest, AStateThatIsDescribedInTimeIsNotReported) {
  Take(State(0, 0, 1));
  Describe(0);
  SetTime(4 * kSecond);
  registry.ReportUndescribed();
  EXPECT_TRUE(TakeReasons().empty());
}

TEST_F(AgentRegistryTest, OfStatesThatWaitTheNewestStays) {
  SetClock(0);
  Take(State(0, kSecond, 1));
  Take(State(0, 0, 2));
  EXPECT_EQ(counters().states_older, 1u);
  Describe(0);
  EXPECT_EQ(alpha->agents().Find(0)->stamp(), Instant::FromNanoseconds(kSecond));
}

TEST_F(AgentRegistryTest, EachStateCountsByWhatBecameOfIt) {
  Join();
  Take(State(0, kSecond, 3));      // newer
  Take(State(0, kSecond, 3));      // repeated
  Take(State(0, kSecond / 2, 4));  // before the newest
  EXPECT_EQ(counters().states_received, 4u);
  EXPECT_EQ(counters().states_accepted, 2u);
  EXPECT_EQ(counters().states_repeated, 1u);
  EXPECT_EQ(counters().states_older, 1u);
  EXPECT_EQ(alpha->states(), 2u);
  EXPECT_EQ(alpha->agents().Find(0)->stamp(), Instant::FromNanoseconds(kSecond));
  EXPECT_EQ(alpha->agents().Find(0)->acknowledged_sequence(), 3u);
}

TEST_F(AgentRegistryTest, AStateOfTheFutureOrOfNoSlotIsRefusedAndChangesNothing) {
  Join();
  Take(State(0, 3600 * kSecond, 2));
  Take(State(70000, 0, 3));
  EXPECT_EQ(TakeReasons(), (Reasons{v1::REJECTED_FUTURE_STAMP, v1::REJECTED_OUT_OF_RANGE}));
  EXPECT_EQ(counters().states_received, 3u);
  EXPECT_EQ(counters().states_accepted, 1u);
  EXPECT_EQ(alpha->agents().Find(0)->acknowledged_sequence(), 1u);
}

// The clock that comes into force may tell that the stamp lies too far ahead.
TEST_F(AgentRegistryTest, TheStampOfAStateThatHasWaitedIsCheckedAgain) {
  Describe(0);
  Take(State(0, 5 * kSecond, 1));
  ASSERT_NE(alpha->agents().Waiting(0), nullptr);
  SetClock(-3600 * kSecond);
  EXPECT_EQ(detector.agents(), 0u);
  EXPECT_EQ(TakeReasons(), Reasons{v1::REJECTED_FUTURE_STAMP});
}

TEST_F(AgentRegistryTest, AStateThatBreaksItsBoundIsAccepted) {
  Join();
  v1::AgentState state = State(0, kSecond, 2);
  state.mutable_position_m()->set_x(1000);
  Take(state);
  EXPECT_EQ(detector.counters().breaches, 1u);
  EXPECT_EQ(counters().states_accepted, 2u);
  EXPECT_EQ(alpha->agents().Find(0)->acknowledged_sequence(), 2u);
}

TEST_F(AgentRegistryTest, WithoutRoomTheOwnerGetsOneRejectionAndTheAgentEntersWhenThereIs) {
  Join();
  Describe(1);
  Take(State(1, 0, 2));
  Describe(2);
  for (const std::uint64_t sequence : {3, 4}) Take(State(2, 0, sequence));
  EXPECT_EQ(detector.agents(), 2u);
  EXPECT_EQ(TakeReasons(), Reasons{v1::REJECTED_TOO_MANY_AGENTS});
  Remove(0);
  Take(State(2, 0, 5));
  EXPECT_EQ(detector.agents(), 2u);
  EXPECT_TRUE(alpha->agents().Find(2)->admitted());
  EXPECT_TRUE(TakeReasons().empty());
}

TEST_F(AgentRegistryTest, AHalfSpaceStaysTheSameWhileItIsThere) {
  SetClock(0);
  v1::AgentDescription floor = Description("alpha", 0);
  floor.set_radius_m(0);
  floor.set_acceleration_max_m_s2(0);
  floor.mutable_half_space()->mutable_normal()->set_z(1);
  Describe(floor);
  Take(State(0, 0, 1));
  EXPECT_EQ(detector.agents(), 1u);
  floor.set_revision(2);
  floor.set_margin_m(0.5);
  Describe(floor);
  EXPECT_EQ(TakeReasons(), Reasons{v1::REJECTED_OUT_OF_RANGE}) << "with a margin it is another one";
  floor.set_revision(3);
  floor.clear_margin_m();
  floor.set_class_name("");
  Describe(floor);
  EXPECT_TRUE(TakeReasons().empty());
  EXPECT_EQ(alpha->agents().Find(0)->revision(), 3u);
  v1::AgentDescription ball = Description("alpha", 0);
  ball.set_revision(4);
  Describe(ball);
  EXPECT_EQ(TakeReasons(), Reasons{v1::REJECTED_OUT_OF_RANGE});
}

TEST_F(AgentRegistryTest, ANewGenerationEndsTheFormerAndItsLateStatesCountAsOlder) {
  Join();
  v1::AgentDescription next = Description("alpha", 0);
  next.set_generation(2);
  Describe(next);
  EXPECT_EQ(counters().removed, 1u);
  EXPECT_EQ(detector.agents(), 0u);
  Take(State(0, kSecond, 2));
  EXPECT_EQ(counters().states_older, 1u);
  EXPECT_EQ(detector.agents(), 0u);
  Describe(0);
  EXPECT_EQ(alpha->agents().Find(0)->generation(), 2u) << "a late description of the former";
  v1::AgentState state = State(0, kSecond, 3);
  state.set_generation(2);
  Take(state);
  EXPECT_EQ(detector.agents(), 1u);
  EXPECT_EQ(counters().admitted, 2u);
}

TEST_F(AgentRegistryTest, OnlyANewerRevisionRedeclaresTheAgent) {
  Join();
  v1::AgentDescription wire = Description("alpha", 0);
  wire.set_radius_m(5);
  Describe(wire);
  EXPECT_EQ(detector.counters().widenings, 0u);
  EXPECT_EQ(alpha->agents().Find(0)->declaration.limits.radius, 1);
  wire.set_revision(2);
  Describe(wire);
  EXPECT_EQ(detector.counters().widenings, 1u);
  EXPECT_EQ(alpha->agents().Find(0)->declaration.limits.radius, 5);
  EXPECT_EQ(alpha->agents().Find(0)->revision(), 2u);
  EXPECT_EQ(counters().removed, 0u);
}

// A description may come again, with another bound, before the agent is there.
TEST_F(AgentRegistryTest, ARevisionBeforeTheAdmissionIsWhatTheAgentIsAdmittedWith) {
  SetClock(0);
  v1::AgentDescription wire = Description("alpha", 0);
  Describe(wire);
  wire.set_revision(2);
  wire.set_radius_m(5);
  Describe(wire);
  Take(State(0, 0, 1));
  EXPECT_EQ(detector.counters().widenings, 0u);
  wire.set_revision(3);
  Describe(wire);
  EXPECT_EQ(detector.counters().widenings, 0u) << "the radius was 5 m from the start";
}

TEST_F(AgentRegistryTest, ARemovedAgentLeavesTheDetectorAndAWaitingStateItsSlot) {
  Join();
  Remove(0);
  EXPECT_EQ(detector.agents(), 0u);
  EXPECT_EQ(counters().removed, 1u);
  EXPECT_EQ(alpha->agents().Find(0), nullptr);
  Take(State(1, 0, 2));
  ASSERT_NE(alpha->agents().Waiting(1), nullptr);
  Remove(1);
  EXPECT_EQ(alpha->agents().Waiting(1), nullptr);
  EXPECT_EQ(counters().removed, 1u) << "no agent";
}

TEST_F(AgentRegistryTest, ACopyOfARemovalThatComesLateDoesNotRemoveTheNextAgentOfTheSlot) {
  Join();
  Remove(0, 2);
  EXPECT_EQ(detector.agents(), 0u);
  v1::AgentDescription next = Description("alpha", 0);
  next.set_generation(2);
  next.set_sequence(3);
  Describe(next);
  Remove(0, 2);
  v1::AgentState state = State(0, 1, 2);
  state.set_generation(2);
  Take(state);
  EXPECT_EQ(detector.agents(), 1u);
  Remove(0, 2);
  EXPECT_EQ(detector.agents(), 1u);
  Remove(0, 4);
  EXPECT_EQ(detector.agents(), 0u);
}

TEST_F(AgentRegistryTest, RemovalOfAllKeepsStatesThatWaitForADescription) {
  Join();
  Describe(1);
  Take(State(2, 0, 2));
  registry.RemoveAll(alpha);
  EXPECT_EQ(detector.agents(), 0u);
  EXPECT_EQ(alpha->agents().size(), 0u);
  EXPECT_EQ(counters().removed, 1u) << "the other one was not admitted";
  EXPECT_NE(alpha->agents().Waiting(2), nullptr);
}

}  // namespace
}  // namespace collision::server
