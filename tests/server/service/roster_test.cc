// Goal:   a service that is killed and started again while a simulator is out of reach grants
//         nobody time past a contact with it, and counts its promises from what was granted before.
// Method: two simulators, of which the second is at rest 60 m ahead of the first: they touch from
//         58 s to 62 s. The daemon, its journal with it, is destroyed without a word and made anew
//         on the same folder; only the first simulator is there at first.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "server/service/roster_journal.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kBegin = 58 * kSecond;

class RosterOfDaemonTest : public testing::Test {
 protected:
  RosterOfDaemonTest() {
    std::string folder = testing::TempDir() + "rosterXXXXXX";
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    config_ = CompleteConfig(Simulated());
    config_.mutable_clock()->set_simulators_awaited(2);
    config_.mutable_clock()->set_grant_ahead_max_s(10);
  }
  ~RosterOfDaemonTest() override { std::filesystem::remove_all(folder_); }

  /// A new process: nothing of the one before is left but its folder.
  void Start(bool with_journal = true) {
    daemon_.reset();
    journal_.reset();
    DaemonParts parts;
    if (with_journal) {
      journal_.emplace(folder_, "lab", 0, config_.simulators_max());
      parts.journal.journal = &*journal_;
      parts.claim.term_before = journal_->term();
      for (const auto& [id, one] : journal_->simulators()) parts.claim.roster.push_back(one);
    }
    if (starts_++ == 1) config_.mutable_clock()->set_simulators_awaited(1);
    daemon_.emplace(CompleteConfig(config_), std::move(parts));
  }

  static std::vector<v1::Input> Told(const std::string& name, std::int64_t clock_ns,
                                     std::uint32_t run = 1) {
    const bool alpha = name == "alpha";
    const std::uint64_t sender = alpha ? 1 : 2;
    const auto sequence = static_cast<std::uint64_t>(clock_ns / 1'000'000) + 1;
    v1::AgentDescription description = Description(name, 0, run);
    description.set_acceleration_max_m_s2(0);
    v1::AgentState state = State(0, clock_ns, sequence);
    state.mutable_position_m()->set_x(alpha ? 1e-9 * static_cast<double>(clock_ns) : 60);
    state.mutable_velocity_m_s()->set_x(alpha ? 1 : 0);
    v1::SimulatorClock clock = ClockAfter(name, clock_ns, sequence, 1);
    clock.set_run(run);
    return {From(sender, description), From(sender, state, name, run), From(sender, clock)};
  }

  std::int64_t granted_ns(const std::string& name) const {
    return daemon_->clearance(SimulatorId(name)).granted_until_ns();
  }

  /// Both go on as far as they are granted, until alpha stands at `until_ns` or nothing moves.
  void FlyTogether(std::int64_t until_ns) {
    for (int step = 0; step < 1000 && alpha_ns_ < until_ns; ++step) {
      if (step > 0 || alpha_ns_ > 0) alpha_ns_ = std::min(until_ns, granted_ns("alpha"));
      daemon_->Step(Told("alpha", alpha_ns_), 0.01);
      daemon_->Step(Told("beta", alpha_ns_), 0.01);
    }
  }

  std::vector<v1::CollisionEvent> confirmed() {
    std::vector<v1::CollisionEvent> events;
    for (const v1::Output& output : daemon_->bus().outputs) {
      if (output.has_collision_event() &&
          output.collision_event().status() == v1::EVENT_CONFIRMED) {
        events.push_back(output.collision_event());
      }
    }
    return events;
  }

  bool has_granted() {
    for (const v1::Output& output : daemon_->bus().outputs) {
      if (output.has_clearance()) return true;
    }
    return false;
  }

  std::string folder_;
  v1::Config config_;
  std::optional<Journal> journal_;
  std::optional<ScriptedDaemon> daemon_;
  int starts_ = 0;
  std::int64_t alpha_ns_ = 0;
};

class RosterReleaseTest : public RosterOfDaemonTest {
 protected:
  RosterReleaseTest() {
    config_.mutable_clock()->set_on_silent_simulator(v1::Clock::RELEASE);
    config_.mutable_clock()->set_release_after_s(8);
  }
};

TEST_F(RosterOfDaemonTest, AfterARestartNobodyIsGrantedTimeBeforeAllAreBack) {
  Start();
  FlyTogether(39 * kSecond);
  ASSERT_EQ(alpha_ns_, 39 * kSecond);
  const std::int64_t granted_before = granted_ns("alpha");
  Start();
  daemon_->Step(Told("alpha", alpha_ns_), 0.01);
  for (int i = 0; i < 100; ++i) daemon_->Step({Told("alpha", alpha_ns_)[2]}, 60);
  EXPECT_FALSE(has_granted());
  EXPECT_EQ(Extension(daemon_->status(), "waiting_for"), "beta");
  EXPECT_EQ(Extension(daemon_->status(), "waiting_why"),
            "beta: not back since the service started again");
  daemon_->Step(Told("beta", alpha_ns_), 0.01);
  EXPECT_EQ(Extension(daemon_->status(), "waiting_for"), "");
  const v1::Clearance clearance = daemon_->clearance(SimulatorId("alpha"));
  ASSERT_EQ(clearance.agents_size(), 1);
  EXPECT_GE(clearance.agents(0).effective_from_ns(), granted_before);
  FlyTogether(61 * kSecond);
  ASSERT_FALSE(confirmed().empty());
  const v1::CollisionEvent contact = confirmed().back();
  EXPECT_LE(contact.begin().earliest_ns(), kBegin);
  EXPECT_GE(contact.begin().latest_ns(), kBegin);
  EXPECT_LE(contact.begin().latest_ns() - contact.begin().earliest_ns(), kSecond);
}

TEST_F(RosterOfDaemonTest, WhoStartedAgainAndHasToldNoClockIsOnFileWithWhatWasGrantedBefore) {
  Start();
  FlyTogether(kSecond);
  const std::optional<Instant> granted = journal_->simulators().at(SimulatorId("beta")).granted;
  ASSERT_TRUE(granted);
  daemon_->Step({Liveliness(2, "beta", false)}, 0.01);
  daemon_->Step({From(12, Description("beta", 0, 2))}, 0.01);
  const JournalledSimulator kept = journal_->simulators().at(SimulatorId("beta"));
  EXPECT_EQ(kept.run, 2u);
  EXPECT_EQ(kept.granted, granted);
  Start();
  daemon_->Step(Told("alpha", alpha_ns_), 0.01);
  EXPECT_FALSE(has_granted());
}

TEST_F(RosterOfDaemonTest, WithoutAJournalItIsGrantedTimePastTheContact) {
  // What the roster is for: the same flight as above.
  Start(false);
  FlyTogether(39 * kSecond);
  Start(false);
  for (int step = 0; step < 100; ++step) {
    daemon_->Step(Told("alpha", alpha_ns_), 0.01);
    alpha_ns_ = granted_ns("alpha");
  }
  EXPECT_GT(granted_ns("alpha"), kBegin + 60 * kSecond);
}

TEST_F(RosterOfDaemonTest, WhatIsOnFileIsNeverLessThanWhatWasGranted) {
  Start();
  std::uint64_t writes = 0;
  std::map<std::uint64_t, JournalledSimulator> before;
  for (std::int64_t t = 0; t <= 50 * kSecond; t += kSecond / 2) {
    FlyTogether(t);
    if (t == 0) FlyTogether(1);
    const auto& on_file = journal_->simulators();
    ASSERT_EQ(on_file.size(), 2u);
    for (const char* name : {"alpha", "beta"}) {
      ASSERT_GE(on_file.at(SimulatorId(name)).granted->nanoseconds(), granted_ns(name));
    }
    writes += on_file != before;
    before = on_file;
  }
  EXPECT_LE(writes, 10u) << "of 100 grants: it is written ahead";
}

TEST_F(RosterOfDaemonTest, AnOperatorMayGiveUpWhoDoesNotComeBack) {
  Start();
  FlyTogether(39 * kSecond);
  Start();
  daemon_->Step(Told("alpha", alpha_ns_), 0.01);
  daemon_->Step({Command(1, v1::OPERATOR_EVICT, "beta")}, 0.01);
  EXPECT_TRUE(has_granted());
  EXPECT_EQ(Extension(daemon_->status(), "operator.0000000000000001"),
            "done: simulator \"beta\" is not waited for any more");
  EXPECT_EQ(journal_->simulators().size(), 1u);
}

TEST_F(RosterReleaseTest, WithReleaseTheRestIsWaitedForSoLongAndNoLonger) {
  Start();
  FlyTogether(39 * kSecond);
  Start();
  daemon_->Step(Told("alpha", alpha_ns_), 0.01);
  daemon_->Pass(7.9);
  EXPECT_FALSE(has_granted());
  EXPECT_LE(daemon_->bus().timeout_ns, kSecond);
  daemon_->Step({}, 0.2);
  EXPECT_TRUE(has_granted());
  EXPECT_EQ(Extension(daemon_->status(), "waiting_for"), "");
}

TEST_F(RosterOfDaemonTest, ALowerRunIsRefusedUntilItsSuccessorIsThere) {
  Start();
  daemon_->Step(Told("alpha", 0, 5), 0.01);
  daemon_->Step(Told("beta", 0), 0.01);
  Start();
  daemon_->Step(Told("alpha", 0, 4), 0.01);
  daemon_->Step(Told("beta", 0), 0.01);
  ASSERT_FALSE(daemon_->rejections().empty());
  EXPECT_EQ(daemon_->rejections()[0].reason(), v1::REJECTED_OLD_RUN);
  EXPECT_FALSE(has_granted());
  daemon_->Step(Told("alpha", 0, 6), 0.01);
  EXPECT_TRUE(has_granted());
}

TEST_F(RosterOfDaemonTest, WhoLeftIsNotWaitedForAndAnEndedEpochLeavesNobody) {
  Start();
  FlyTogether(5 * kSecond);
  daemon_->Step({Removal(2, "beta", 0), Liveliness(2, "beta", false)}, 0.01);
  EXPECT_EQ(journal_->simulators().size(), 1u);
  Start();
  daemon_->Step(Told("alpha", alpha_ns_), 0.01);
  EXPECT_TRUE(has_granted());
  daemon_->Step({Removal(1, "alpha", 0), Liveliness(1, "alpha", false)}, 0.01);
  EXPECT_TRUE(journal_->simulators().empty());
  EXPECT_EQ(journal_->epoch(), 2u);
}

TEST_F(RosterOfDaemonTest, AWallClockForgetsARosterThatAnEarlierConfigurationLeft) {
  Start();
  FlyTogether(5 * kSecond);
  ASSERT_EQ(journal_->simulators().size(), 2u);
  config_ = {};
  config_.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config_ = CompleteConfig(config_);
  Start();
  EXPECT_EQ(Extension(daemon_->status(), "waiting_for"), "");
  EXPECT_TRUE(journal_->simulators().empty());
}

TEST_F(RosterOfDaemonTest, NewcomersBesideAFullRosterFindRoomOnceItIsComplete) {
  config_.set_simulators_max(2);
  Start();
  FlyTogether(kSecond);
  Start();
  for (const char* name : {"gamma", "delta"}) {
    v1::SimulatorClock clock = ClockOf(name, 0);
    daemon_->Step({From(name[0], clock)}, 0.01);
  }
  EXPECT_FALSE(has_granted());
  daemon_->Step({Command(1, v1::OPERATOR_EVICT, "alpha"), Command(2, v1::OPERATOR_EVICT, "beta")},
                0.01);
  EXPECT_TRUE(has_granted());
  EXPECT_EQ(journal_->simulators().count(SimulatorId("gamma")), 1u);
  EXPECT_EQ(journal_->simulators().count(SimulatorId("delta")), 1u);
}

}  // namespace
}  // namespace collision::server
