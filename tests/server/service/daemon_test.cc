#include "server/service/daemon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "server/process/logging.h"
#include "server/recording/recording.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"
#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kAlpha = 10;  // a sender

v1::Config Wall() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_skew_max_s(0.002);
  return config;
}

// Goal:   with a wall clock a contact is announced before it begins and confirmed after it.
// Method: two agents 32 m apart close in at 6 m/s, states at 10 Hz; they touch after 5 s. With M =
//         2 each, 20 m may be bridged in 2 s: the announcement is due after 1.67 s.
TEST(Daemon, WallClockFindsAContact) {
  ScriptedDaemon daemon(Wall());
  const std::int64_t start = daemon.bus().wall_ns;
  std::vector<v1::Input> inputs = {From(kAlpha, Description("alpha", 0)),
                                   From(kAlpha, Description("alpha", 1))};
  std::int64_t announced = kNeverNs;
  v1::EventStatus status = v1::EVENT_POSSIBLE;
  for (int step = 0; step < 55; ++step) {
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      v1::AgentState state = State(slot, start + step * kSecond / 10, step * 2 + slot + 1);
      state.mutable_position_m()->set_x(slot == 0 ? 0 : 32 - 0.6 * step);
      state.mutable_velocity_m_s()->set_x(slot == 0 ? 0 : -6);
      inputs.push_back(From(kAlpha, state, "alpha"));
    }
    daemon.Step(inputs, step == 0 ? 0 : 0.1);
    inputs.clear();
    for (const v1::Output& output : daemon.bus().outputs) {
      if (!output.has_collision_event()) continue;
      announced = std::min(announced, output.collision_event().now_ns());
      status = output.collision_event().status();
    }
  }
  EXPECT_LE(announced, start + 5 * kSecond);
  EXPECT_GE(announced, start + 1 * kSecond);
  EXPECT_EQ(status, v1::EVENT_CONFIRMED);
  EXPECT_EQ(daemon.counter("breaches"), 0u);
}

// Goal:   a dead simulator that holds up the world is named: in the log once per death, also if two
//         die within a second, and in the status while it is waited for. So is a released one.
TEST(Daemon, NamesTheDeadThatHoldUpTheWorld) {
  const std::string path = TemporaryPath("daemon_test.log");
  StartLogging({.level = "info", .file = path});
  v1::Config config = Simulated();
  config.mutable_clock()->set_on_silent_simulator(v1::Clock::RELEASE);
  ScriptedDaemon daemon(config);
  for (const char* name : {"alpha", "beta"}) {
    daemon.Step(
        {From(SimulatorId(name), Description(name, 0)), From(SimulatorId(name), ClockOf(name, 0))});
  }
  const auto waiting_for = [&daemon] {
    const v1::ServiceStatus status = daemon.status();
    for (const v1::KeyValue& extension : status.extensions()) {
      if (extension.key() == "waiting_for") return extension.value();
    }
    return std::string();
  };
  EXPECT_EQ(waiting_for(), "");
  daemon.Step({Liveliness(SimulatorId("alpha"), "alpha", false)});
  daemon.Step({Liveliness(SimulatorId("beta"), "beta", false)}, 0.1);
  const std::string waited_for = waiting_for();
  EXPECT_NE(waited_for.find("alpha"), std::string::npos) << waited_for;
  EXPECT_NE(waited_for.find("beta"), std::string::npos) << waited_for;
  for (int step = 0; step < 10; ++step) daemon.Step({}, 1);
  EXPECT_EQ(waiting_for(), "");
  EndLogging();
  StartLogging({.level = "info"});
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::remove(path.c_str());
  const std::string log = text.str();
  EXPECT_NE(log.find("it is not heard: its process has ended, or stands still"), std::string::npos);
  EXPECT_EQ(log.find("(or set clock.on_silent_simulator"), std::string::npos) << "it is RELEASE";
  for (const char* line : {"waits for simulator \"alpha\"", "waits for simulator \"beta\"",
                           "goes on without simulator"}) {
    EXPECT_NE(log.find(line), std::string::npos) << log;
    EXPECT_EQ(log.find(line), log.rfind(line)) << log;
  }
  EXPECT_NE(log.find("without simulator \"alpha\", \"beta\": "), std::string::npos) << log;
}

// Goal:   a description that widens is acknowledged, lowers the clearance, and says so.
TEST(Daemon, AWiderDescriptionLowersTheClearance) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  const v1::AgentClearance before = daemon.clearance(SimulatorId("alpha")).agents(0);
  v1::AgentDescription wider = Description("alpha", 0);
  wider.set_acceleration_max_m_s2(20);
  wider.set_revision(2);
  daemon.Step({From(kAlpha, wider)});
  const v1::AgentClearance after = daemon.clearance(SimulatorId("alpha")).agents(0);
  EXPECT_EQ(after.acknowledged_revision(), 2u);
  EXPECT_LT(after.clear_until_ns(), before.clear_until_ns());
  EXPECT_EQ(after.cause(), v1::CAUSE_WIDENING);
  EXPECT_EQ(after.effective_from_ns(), before.clear_until_ns());
}

// Goal:   with a wall clock a stamp may lie ahead by κ and no more, and the daemon wakes by itself.
TEST(Daemon, WallClockRefusesStampsFromTheFuture) {
  ScriptedDaemon daemon(Wall());
  const std::int64_t now = daemon.bus().wall_ns;
  daemon.Step(
      {From(kAlpha, Description("alpha", 0)), From(kAlpha, State(0, now + 2'000'001, 1), "alpha")});
  ASSERT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_FUTURE_STAMP);
  daemon.Step({From(kAlpha, State(0, now + 2'000'000, 2), "alpha")});
  EXPECT_EQ(daemon.status().agents(), 1u);
  daemon.Step({}, 1);
  EXPECT_LE(daemon.bus().timeout_ns, kSecond / 60 + 1);
}

// Goal:   grants reach the simulators in every clearance sample, and time follows their clocks.
TEST(Daemon, GrantsTimeInLockStep) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  // 100 m, radii 1, M = 2 each: 98 = 2 · ½ · 2 · t².
  const v1::Clearance clearance = daemon.clearance(SimulatorId("alpha"));
  EXPECT_NEAR(static_cast<double>(clearance.granted_until_ns()), 7e9, 1e3);
  EXPECT_LE(clearance.granted_until_ns(), 7 * kSecond);
  EXPECT_EQ(clearance.agents_size(), 2);
  daemon.Step({From(kAlpha, ClockAfter("alpha", 5 * kSecond, 2, 2))});
  EXPECT_EQ(daemon.status().now_ns(), 5 * kSecond);
}

// Goal:   a clock that overtakes its states waits for them.
TEST(Daemon, AClockWaitsForItsStates) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  daemon.Step({From(kAlpha, ClockAfter("alpha", kSecond, 3, 2))});
  EXPECT_EQ(daemon.status().now_ns(), 0);
  daemon.Step({From(kAlpha, State(0, kSecond, 3), "alpha")});
  EXPECT_EQ(daemon.status().now_ns(), kSecond);
}

/// Keeps batches in memory, or fails.
class MemorySink final : public BatchSink {
 public:
  bool Record(const v1::RecordedBatch& batch) override {
    batches.push_back(batch);
    return !fails;
  }
  std::string error() const override { return fails ? "the disk is full" : ""; }
  std::vector<v1::RecordedBatch> batches;
  bool fails = false;
};

v1::Config OnRecordingFailure(v1::Config::OnFailure on_failure) {
  v1::Config config = Simulated();
  config.set_on_recording_failure(on_failure);
  return config;
}

TEST(Daemon, RecordsWhatItAppliesAndEndsIfItCannot) {
  MemorySink sink;
  ScriptedDaemon daemon(OnRecordingFailure(v1::Config::END), &sink);
  std::vector<v1::Input> joins = AlphaJoins(kAlpha);
  std::reverse(joins.begin(), joins.end());
  daemon.Step(joins, 1);
  ASSERT_EQ(sink.batches.size(), 1u);
  EXPECT_EQ(sink.batches[0].monotonic_ns(), kSecond);
  ASSERT_EQ(sink.batches[0].inputs_size(), 4);
  EXPECT_TRUE(sink.batches[0].inputs(0).has_agent_description());
  EXPECT_TRUE(sink.batches[0].inputs(3).has_simulator_clock());
  sink.fails = true;
  const int flushes = daemon.bus().flushes;
  EXPECT_FALSE(daemon.daemon().Step());
  EXPECT_EQ(daemon.bus().flushes, flushes);
}

TEST(Daemon, GoesOnWithoutARecordingAndTells) {
  MemorySink sink;
  ScriptedDaemon daemon(OnRecordingFailure(v1::Config::GO_ON), &sink);
  EXPECT_EQ(Extension(daemon.status(), "recording_failure"), "");
  const std::size_t kept = sink.batches.size();
  sink.fails = true;
  daemon.Step(AlphaJoins(kAlpha), 1);
  EXPECT_NO_THROW(daemon.clearance(SimulatorId("alpha")));
  EXPECT_EQ(Extension(daemon.status(), "recording_failure"), "the disk is full");
  EXPECT_EQ(sink.batches.size(), kept + 1) << "after a gap nothing is recorded";
}

TEST(Daemon, StopsOnRequestOrWhenTheBusEnds) {
  ScriptedDaemon stopped(Simulated());
  stopped.daemon().Stop();
  EXPECT_TRUE(stopped.bus().woken);
  EXPECT_FALSE(stopped.daemon().Step());
  ScriptedDaemon ended(Simulated());
  ended.bus().ended = true;
  ended.bus().next = AlphaJoins(kAlpha);
  EXPECT_FALSE(ended.daemon().Step());
  EXPECT_EQ(ended.bus().flushes, 1);
}

}  // namespace
}  // namespace collision::server
