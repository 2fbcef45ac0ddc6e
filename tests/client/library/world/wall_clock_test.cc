// Goal:   with a wall clock the library answers the service's samples so that it can measure the
//         simulator's clock, and lives through steps of that clock and of the service's.
// Method: a network and a clock under the test's control.
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kStart = 1'700'000'000 * kSecond;
constexpr std::uint64_t kService = 5;

class WallClockTest : public testing::Test {
 protected:
  explicit WallClockTest(bool lock_step = false)
      : world_(ConnectTo(network_,
                         {.lock_step = lock_step, .wall_clock = [this] { return now_ns_; }})),
        agent_(world_.AddAgent({.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 0},
                               {.stamp_ns = kStart})) {}

  /// The service publishes its status as of `now_ns`, and it is heard.
  void Hear(std::int64_t now_ns, std::uint32_t epoch = 1) {
    v1::ServiceStatus& status = *network_->arriving.emplace_back().mutable_service_status();
    status.set_phase(v1::PHASE_SERVING);
    Stamp(epoch, status.mutable_stamp());
    status.set_now_ns(now_ns);
    world_.Poll();
  }
  /// The service has this state of the agent, and wants no other one.
  void Acknowledge(std::uint64_t sequence, std::uint32_t epoch = 1) {
    v1::Clearance& clearance = *network_->arriving.emplace_back().mutable_clearance();
    clearance.set_simulator_id(SimulatorId(kSimulator));
    clearance.set_run(kRun);
    Stamp(epoch, clearance.mutable_stamp());
    clearance.set_now_ns(now_ns_);
    v1::AgentClearance& agent = *clearance.add_agents();
    agent.set_generation(1);
    agent.set_acknowledged_sequence(sequence);
    agent.set_clear_until_ns(kNever);
    agent.set_state_wanted_ns(kNever);
    world_.Poll();
  }
  /// The service has ended its run.
  void EndRun(v1::RunEnd why) {
    v1::SimulatorReport& report = *network_->arriving.emplace_back().mutable_simulator_report();
    report.set_simulator_id(SimulatorId(kSimulator));
    report.set_run(kRun);
    report.set_incarnation(LastClock().incarnation());
    report.set_ended(why);
    Stamp(1, report.mutable_stamp());
    network_->alive = true;
  }
  static void Stamp(std::uint32_t epoch, v1::ServiceStamp* stamp) {
    stamp->set_service_id(kService);
    stamp->set_term(1);
    stamp->set_epoch(epoch);
  }

  /// The simulator sets its state of now, and publishes.
  void Tell() {
    agent_.SetState({.stamp_ns = now_ns_});
    world_.Publish(now_ns_);
  }
  v1::SimulatorClock LastClock() const { return network_->Clocks().back(); }
  std::size_t StatesSent() const { return network_->States().size(); }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  std::int64_t now_ns_ = kStart;
  World world_;
  Agent agent_;
};

class LockStepTest : public WallClockTest {
 protected:
  LockStepTest() : WallClockTest(true) {}
};

TEST_F(WallClockTest, AClockAnswersTheNewestSample) {
  Tell();
  EXPECT_EQ(LastClock().echo_ns(), kNever) << "nothing was heard";
  EXPECT_EQ(LastClock().sent_ns(), kStart);
  now_ns_ += 10;
  Hear(kStart + 3);
  Hear(kStart + 3);
  now_ns_ += 10;
  Hear(kStart + 2);
  Tell();
  EXPECT_EQ(LastClock().service_id(), kService);
  EXPECT_EQ(LastClock().epoch(), 1u);
  EXPECT_EQ(LastClock().echo_ns(), kStart + 3);
  EXPECT_EQ(LastClock().heard_ns(), kStart + 10) << "when it first came";
  EXPECT_EQ(LastClock().sent_ns(), kStart + 20);
}

TEST_F(LockStepTest, ThereIsNothingToMeasureInLockStep) {
  Hear(kStart);
  world_.Publish(0);
  EXPECT_EQ(LastClock().sent_ns(), 0);
  EXPECT_EQ(LastClock().echo_ns(), 0);
}

TEST_F(WallClockTest, InANewEpochTheNextStateIsSentAlthoughTheLastStoodInForIt) {
  Hear(kStart);
  Tell();
  Acknowledge(1);
  now_ns_ += kSecond;
  Tell();
  ASSERT_EQ(StatesSent(), 1u) << "it is at rest: no other state is wanted";
  Hear(kStart + kSecond, 2);
  now_ns_ += kSecond;
  Tell();
  ASSERT_EQ(StatesSent(), 2u);
  EXPECT_EQ(network_->States().back().states(0).stamp_ns(), now_ns_);
}

TEST_F(WallClockTest, WhatTheServiceSaidInTheFormerEpochDoesNotCount) {
  Hear(kStart);
  Tell();
  Hear(kStart - 12 * kSecond, 2);
  now_ns_ += kSecond;
  Acknowledge(1, 1);
  EXPECT_NE(agent_.clearance().clear_until_ns, kNever);
  Tell();
  EXPECT_EQ(LastClock().echo_ns(), kStart - 12 * kSecond);
  EXPECT_EQ(LastClock().epoch(), 2u);
}

TEST_F(WallClockTest, AClockThatWasSetBackIsSilentUntilTheNextEpoch) {
  Hear(kStart);
  Tell();
  Acknowledge(1);
  now_ns_ -= 12 * kSecond;
  Tell();
  EXPECT_EQ(StatesSent(), 1u);
  EXPECT_EQ(LastClock().clock_ns(), kStart) << "it repeats itself";
  EXPECT_EQ(LastClock().sent_ns(), now_ns_) << "so that the service can measure the step";
  Hear(kStart - 12 * kSecond, 2);
  Tell();
  ASSERT_EQ(StatesSent(), 2u);
  EXPECT_EQ(network_->States().back().states(0).stamp_ns(), kStart - 12 * kSecond);
  EXPECT_EQ(LastClock().clock_ns(), kStart - 12 * kSecond);
}

TEST_F(WallClockTest, AClockThatWasSetBackGoesOnOnceItHasCaughtUp) {
  Tell();
  now_ns_ -= kSecond;
  Tell();
  EXPECT_EQ(StatesSent(), 1u);
  now_ns_ += 2 * kSecond;
  Tell();
  EXPECT_EQ(StatesSent(), 2u);
  EXPECT_EQ(LastClock().clock_ns(), now_ns_);
}

TEST_F(WallClockTest, TheClockDoesNotPassAJumpThatTheServiceMayNotHave) {
  const auto jump = [this] {
    now_ns_ += kSecond;
    agent_.SetState({.stamp_ns = now_ns_, .discontinuity = true});
    world_.Publish(now_ns_);
    return now_ns_;
  };
  Tell();
  Hear(now_ns_);
  Acknowledge(1);
  const std::int64_t first_ns = jump();
  const std::int64_t second_ns = jump();
  now_ns_ += kSecond;
  Tell();
  EXPECT_EQ(LastClock().clock_ns(), first_ns);
  Acknowledge(2);
  EXPECT_EQ(LastClock().clock_ns(), second_ns);
  Acknowledge(3);
  EXPECT_EQ(LastClock().clock_ns(), now_ns_) << "told at once, without another Publish()";
  const std::size_t clocks = network_->Clocks().size();
  world_.Poll();
  EXPECT_EQ(network_->Clocks().size(), clocks);
}

// It may have been admitted, and the answer be on its way.
TEST_F(WallClockTest, TheClockWaitsASecondForAJumpBeforeTheFirstAnswer) {
  Tell();
  now_ns_ += kSecond / 4;
  const std::int64_t jump_ns = now_ns_;
  agent_.SetState({.stamp_ns = jump_ns, .discontinuity = true});
  world_.Publish(now_ns_);
  now_ns_ += kSecond / 4;
  Tell();
  EXPECT_EQ(LastClock().clock_ns(), jump_ns);
  now_ns_ += 3 * kSecond / 4;
  Tell();
  EXPECT_EQ(LastClock().clock_ns(), now_ns_);
}

// The service may refuse it, and would not hear of any time then.
TEST_F(WallClockTest, TheClockGoesOnBesideJumpsOfAnAgentThatIsNotAdmitted) {
  Tell();
  now_ns_ += kSecond;
  agent_.SetState({.stamp_ns = now_ns_, .discontinuity = true});
  world_.Publish(now_ns_);
  now_ns_ += kSecond;
  Tell();
  EXPECT_EQ(LastClock().clock_ns(), now_ns_);
}

TEST_F(WallClockTest, TheClockGoesOnWhenTheAgentThatJumpedIsRemoved) {
  Tell();
  Hear(now_ns_);
  Acknowledge(1);
  now_ns_ += kSecond;
  agent_.SetState({.stamp_ns = now_ns_, .discontinuity = true});
  world_.Publish(now_ns_);
  { const Agent removed = std::move(agent_); }
  now_ns_ += kSecond;
  world_.Publish(now_ns_);
  EXPECT_EQ(LastClock().clock_ns(), now_ns_);
}

TEST_F(WallClockTest, BeforeItsFirstClockItTellsThatItIsThere) {
  world_.Poll();
  ASSERT_EQ(network_->Clocks().size(), 1u);
  EXPECT_EQ(LastClock().clock_ns(), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(LastClock().agents(), 1u);
  EXPECT_EQ(LastClock().sent_ns(), now_ns_);
  world_.Poll();
  EXPECT_EQ(network_->Clocks().size(), 1u) << "every half a second";
  Tell();
  EXPECT_EQ(LastClock().clock_ns(), now_ns_);
}

TEST_F(WallClockTest, ARunThatEndsInSilenceBeforeItsFirstClockIsFollowedByTheNextOneToo) {
  world_.Poll();
  EndRun(v1::RUN_SILENT);
  network_->written.clear();
  world_.Poll();
  ASSERT_EQ(network_->Clocks().size(), 1u);
  EXPECT_EQ(LastClock().run(), kRun + 1);
  ASSERT_TRUE(network_->written.front().has_agent_description());
  EXPECT_EQ(network_->written.front().agent_description().run(), kRun + 1);
}

TEST_F(LockStepTest, InLockStepItAsksNothingBeforeItsFirstClock) {
  world_.Poll();
  EXPECT_TRUE(network_->Clocks().empty());
}

TEST_F(WallClockTest, WhenItsRunEndedInSilenceNoPromiseStandsAndEverythingIsSentInTheNext) {
  std::vector<AgentId> voided;
  world_.OnVoid([&](const AgentId& id, const Clearance& clearance) {
    EXPECT_EQ(clearance.void_from_ns, std::numeric_limits<std::int64_t>::min());
    voided.push_back(id);
  });
  Tell();
  Hear(now_ns_);
  Acknowledge(1);
  EndRun(v1::RUN_SILENT);
  const std::size_t states = StatesSent();
  world_.Poll();
  EXPECT_EQ(voided, std::vector<AgentId>{agent_.id()});
  EXPECT_EQ(agent_.id().run, kRun + 1);
  EXPECT_EQ(LastClock().run(), kRun + 1);
  EXPECT_GT(StatesSent(), states);
}

TEST_F(LockStepTest, InLockStepTimeThatGoesBackIsStillAnError) {
  world_.Publish(kSecond);
  EXPECT_THROW(world_.Publish(0), std::invalid_argument);
}

}  // namespace
}  // namespace collision::client
