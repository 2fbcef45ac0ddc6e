// Goal:   each breach is counted; an agent is told of at its first breach in a second and with the
//         last count when that is over, and no simulator can have more told than its part.
// Method: agents that move by a metre in a millisecond, in a detector of their own.
#include "server/intake/agent_breaches.h"

#include <gtest/gtest.h>

#include "server/config/config.h"
#include "tests/server/messages.h"

namespace collision::server {
namespace {

class AgentBreachesTest : public testing::Test {
 protected:
  static constexpr std::int64_t kSecond = 1'000'000'000;

  AgentBreachesTest() {
    for (const std::string name : {"alpha", "beta"}) {
      world_.ClaimFor(SimulatorId(name), kSender, 1, &name);
    }
    SetTime(0);
  }

  void SetTime(std::int64_t ns) { world_.SetReading({.wall_ns = ns, .monotonic_ns = ns}); }

  /// The next breach of this agent, at its next millisecond.
  void Break(const std::string& simulator, std::uint32_t slot) {
    const detection::AgentId id{SimulatorId(simulator), slot, 1, 1};
    detection::AgentDeclaration ball;
    ball.limits.radius = 0.1;
    ball.limits.acceleration_max = 2;
    motion::MotionState state;
    std::uint64_t& count = counts_[id];
    if (count == 0) {
      ASSERT_TRUE(detectors_.Admit(id, ball, state, Instant::FromNanoseconds(0)));
    }
    ++count;
    state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(count) * 1'000'000);
    state.p_WA.x() = static_cast<double>(count);
    ASSERT_EQ(detectors_.Update(id, state, state.stamp), detection::UpdateOutcome::kBreached);
    breaches_.Add(*world_.Find(id.simulator), id, count);
  }

  static constexpr std::uint64_t kSender = 10;
  const v1::Config config_ = CompleteConfig({});
  World world_{config_};
  Detectors detectors_{config_};
  AgentBreaches breaches_{&world_, &detectors_};
  std::map<detection::AgentId, std::uint64_t> counts_;
};

TEST_F(AgentBreachesTest, TheFirstIsToldAtOnceWithFieldDeclaredAndSeen) {
  Break("alpha", 3);
  const auto told = breaches_.Take();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].simulator_id(), SimulatorId("alpha"));
  EXPECT_EQ(told[0].slot(), 3u);
  EXPECT_EQ(told[0].generation(), 1u);
  EXPECT_EQ(told[0].run(), 1u);
  EXPECT_EQ(told[0].field(), "acceleration_max_m_s2");
  EXPECT_EQ(told[0].declared(), 2);
  // Of what rests at both ends and moves by 1 m in 1 ms: to the middle and back, 4 m / (1 ms)².
  EXPECT_LE(told[0].seen(), 4e6);
  EXPECT_GE(told[0].seen(), 3.99e6);
  EXPECT_EQ(told[0].from_ns(), 0);
  EXPECT_EQ(told[0].at_ns(), 1'000'000);
  EXPECT_EQ(told[0].count(), 1u);
  EXPECT_TRUE(breaches_.Take().empty());
  EXPECT_FALSE(breaches_.NextDue());
}

TEST_F(AgentBreachesTest, FurtherOnesAreCountedAndToldWhenTheSecondIsOver) {
  for (int i = 0; i < 4; ++i) Break("alpha", 0);
  EXPECT_EQ(breaches_.Take().size(), 1u);
  EXPECT_EQ(breaches_.NextDue(), kSecond);
  SetTime(kSecond - 1);
  EXPECT_TRUE(breaches_.Take().empty());
  SetTime(kSecond);
  const auto told = breaches_.Take();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].count(), 4u);
  EXPECT_EQ(told[0].at_ns(), 1'000'000) << "of the one that was explained";
  EXPECT_FALSE(breaches_.NextDue());
  Break("alpha", 0);
  const auto anew = breaches_.Take();
  ASSERT_EQ(anew.size(), 1u);
  EXPECT_EQ(anew[0].count(), 5u);
  EXPECT_EQ(anew[0].at_ns(), 5'000'000);
}

TEST_F(AgentBreachesTest, OneSimulatorLeavesRoomForOthers) {
  for (std::uint32_t slot = 0; slot < 2 * kBreachesOfOneToldMax; ++slot) Break("alpha", slot);
  Break("beta", 0);
  const auto told = breaches_.Take();
  ASSERT_EQ(told.size(), kBreachesOfOneToldMax + 1);
  EXPECT_EQ(told.back().simulator_id(), SimulatorId("beta"));
  SetTime(kSecond);
  Break("alpha", 2 * kBreachesOfOneToldMax - 1);
  EXPECT_EQ(breaches_.Take().size(), 1u) << "with its next breach";
}

TEST_F(AgentBreachesTest, WhatWasCountedOfARunThatIsOverIsNotTold) {
  Break("alpha", 0);
  Break("alpha", 0);
  EXPECT_EQ(breaches_.Take().size(), 1u);
  world_.StartRun(world_.Find(SimulatorId("alpha")), kSender, 2, false);
  ASSERT_EQ(world_.Find(SimulatorId("alpha"))->run(), 2u);
  SetTime(kSecond);
  EXPECT_TRUE(breaches_.Take().empty());
}

}  // namespace
}  // namespace collision::server
