// Goal:   of the states that an agent sends in one round the newest counts, its first, jumps, and
//         those that break what it declares, whatever else arrives; also of an agent that comes and
//         goes within the round.
// Method: one simulator in a world without a bus; the test hands over each message.
#include "tests/server/intake/agent_registry_fixture.h"

namespace collision::server {
namespace {

/// States of an agent at rest that wait for the end of a round, in which nothing but the newest
/// counts, unless they break what the agent declares: 2 m/s².
class RoundsTest : public AgentRegistryTest {
 protected:
  /// At x after so many milliseconds, which is also the number of the state.
  void Hear(std::uint64_t ms, double x, bool jumps = false) {
    v1::AgentState state = State(0, static_cast<std::int64_t>(ms) * 1'000'000, ms);
    state.mutable_position_m()->set_x(x);
    state.set_discontinuity(jumps);
    registry.TakeState(alpha, Chunk("alpha"), state);
  }
  /// Time has begun, and the simulator's next step is in an hour.
  void BeginRound() {
    alpha->time().Offer({.clock = Instant(), .next = Instant::FromNanoseconds(3600 * kSecond)});
    ASSERT_TRUE(alpha->time().Take());
    world.MoveOn();
    ASSERT_TRUE(world.started() && world.RunsInRounds());
  }
  /// Without an end of the round.
  void Announce(std::uint32_t slot) {
    const v1::AgentDescription wire = Description("alpha", slot);
    registry.Describe(alpha, wire, std::get<detection::AgentDeclaration>(DecodeDescription(wire)));
  }
  std::uint64_t BreachesOfRound() {
    const std::uint64_t before = detector.counters().breaches;
    registry.Enact(alpha);
    return detector.counters().breaches - before;
  }
};

TEST_F(RoundsTest, OfStatesThatFollowTheNewestCounts) {
  Join();
  for (const std::uint64_t ms : {10, 20, 30}) Hear(ms, 0);
  EXPECT_EQ(BreachesOfRound(), 0u);
  EXPECT_EQ(counters().states_accepted, 2u);
  EXPECT_EQ(alpha->agents().Find(0)->acknowledged_sequence(), 30u);
}

TEST_F(RoundsTest, AnAgentThatLeapsAndIsBackBeforeTheRoundIsOverHasBrokenItsWord) {
  Join();
  Hear(10, 0);
  Hear(20, 100);
  Hear(30, 0);
  Hear(40, 0);
  Hear(50, 0);
  EXPECT_EQ(BreachesOfRound(), 2u) << "there and back";
  EXPECT_EQ(counters().states_accepted, 5u) << "the first, and of these all but the one at 40 ms";
}

// A metre in 10 ms is a leap; in 2 s it is none.
TEST_F(RoundsTest, ALeapFromTheStateInForceIsSeenThoughItCouldHaveWalked) {
  Join();
  Hear(10, 1);
  Hear(2000, 1);
  EXPECT_EQ(BreachesOfRound(), 1u);
  Hear(2010, 1);
  Hear(4000, 0);
  EXPECT_EQ(BreachesOfRound(), 0u);
}

TEST_F(RoundsTest, ALeapThatIsDeclaredIsNoBreach) {
  Join();
  Hear(10, 0);
  Hear(20, 100, true);
  Hear(30, 100);
  EXPECT_EQ(BreachesOfRound(), 0u);
  EXPECT_EQ(detector.counters().jumps, 1u);
}

TEST_F(RoundsTest, AnAgentBeginsWithItsFirstState) {
  BeginRound();
  Describe(0);
  for (const std::uint64_t ms : {10, 20, 30, 40}) Hear(ms, 0);
  EXPECT_EQ(BreachesOfRound(), 0u);
  EXPECT_EQ(counters().states_accepted, 2u) << "the first and the newest";
  ASSERT_TRUE(alpha->agents().Find(0)->admitted());
  EXPECT_EQ(alpha->agents().Find(0)->acknowledged_sequence(), 40u);
}

TEST_F(RoundsTest, WhatAnAgentDoesBeforeItIsDescribedCounts) {
  BeginRound();
  Hear(10, 0);
  Hear(20, 100, true);
  Hear(30, 100);
  Hear(40, 200, true);
  Describe(0);
  EXPECT_EQ(BreachesOfRound(), 0u);
  EXPECT_EQ(detector.counters().jumps, 2u);
  EXPECT_EQ(counters().states_accepted, 3u);
}

// Nobody knows what it met before the oldest of the jumps that are kept.
TEST_F(RoundsTest, OfMoreJumpsThanCanWaitTheOldestThatIsKeptIsABreach) {
  BeginRound();
  Describe(0);
  for (std::uint64_t k = 0; k < kWaitingBeforeMax + 2; ++k) {
    Hear(k + 1, 100 * static_cast<double>(k), k > 0);
  }
  EXPECT_EQ(BreachesOfRound(), 1u) << "it begins with its first state";
  EXPECT_EQ(counters().states_accepted, kWaitingBeforeMax + 1);
  for (const std::uint64_t jumps : {kWaitingBeforeMax + 1, kWaitingBeforeMax + 2}) {
    for (std::uint64_t k = 1; k <= jumps; ++k) {
      Hear(100 * jumps + k, 100 * static_cast<double>(k), true);
    }
    EXPECT_EQ(BreachesOfRound(), jumps > kWaitingBeforeMax + 1 ? 1u : 0u);
  }
}

TEST_F(RoundsTest, AnAgentThatLeapsInItsFirstRoundHasBrokenItsWord) {
  BeginRound();
  Describe(0);
  Hear(10, 0);
  Hear(20, 100);
  Hear(30, 0);
  EXPECT_EQ(BreachesOfRound(), 2u);
}

TEST_F(RoundsTest, AnAgentThatComesAndGoesIsJudgedAtTheEndOfTheRound) {
  BeginRound();
  Announce(0);
  Hear(10, 0);
  Hear(20, 0);
  registry.Remove(alpha, 0, 0);
  EXPECT_NE(alpha->agents().Find(0), nullptr);
  EXPECT_TRUE(registry.AllLeave(*alpha));
  registry.Enact(alpha);
  EXPECT_EQ(alpha->agents().Find(0), nullptr);
  EXPECT_EQ(counters().admitted, 1u);
  EXPECT_EQ(counters().removed, 1u);
  EXPECT_EQ(detector.agents(), 0u);
}

// Its states may come after its removal, and its removal before time has begun.
TEST_F(RoundsTest, WhatComesAfterTheRemovalInTheSameRoundCounts) {
  Announce(0);
  registry.Remove(alpha, 0, 0);
  EXPECT_EQ(alpha->agents().Find(0), nullptr) << "time has not begun";
  BeginRound();
  Announce(1);
  registry.Remove(alpha, 1, 0);
  v1::AgentState state = State(1, 0, 1);
  registry.TakeState(alpha, Chunk("alpha"), state);
  registry.Enact(alpha);
  EXPECT_EQ(counters().admitted, 1u);
  EXPECT_EQ(counters().removed, 1u);
}

// It sped up to 10 ms, and told before the last two states that it would not any more.
TEST_F(RoundsTest, ANarrowerBoundCountsFromTheStateAfterIt) {
  Join();
  v1::AgentDescription narrower = Description("alpha", 0);
  narrower.set_revision(2);
  narrower.set_acceleration_max_m_s2(0);
  narrower.set_states_sequence(10);
  Describe(narrower);
  const auto hear = [&](std::uint64_t ms, double x, double v) {
    v1::AgentState state = State(0, static_cast<std::int64_t>(ms) * 1'000'000, ms);
    state.mutable_position_m()->set_x(x);
    state.mutable_velocity_m_s()->set_x(v);
    registry.TakeState(alpha, Chunk("alpha"), state);
  };
  hear(10, 0.0001, 0.02);
  hear(20, 0.0004, 0.04);
  hear(30, 0.0008, 0.04);
  EXPECT_EQ(BreachesOfRound(), 0u);
  EXPECT_EQ(counters().states_accepted, 2u) << "nothing but the newest counts";
  hear(40, 0.0013, 0.06);
  hear(50, 0.0019, 0.06);
  EXPECT_EQ(BreachesOfRound(), 1u);
}

}  // namespace
}  // namespace collision::server
