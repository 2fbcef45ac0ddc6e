// Goal:   what a restarted service knew of the one before it, what operators asked of it, and whom
//         it removed, happens again in a replay, in the same steps.
// Method: a run with a roster, a release, a removal and an eviction is recorded and replayed; the
//         outputs are compared one by one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "server/recording/replay/replay.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

class SilenceReplayTest : public testing::Test {
 protected:
  SilenceReplayTest() {
    v1::Config config = Simulated();
    config.mutable_clock()->set_on_silent_simulator(v1::Clock::RELEASE);
    config.mutable_clock()->set_release_after_s(8);
    config.mutable_clock()->set_remove_silent_after_s(20);
    config_ = CompleteConfig(config);
    claim_.instance = 7;
    claim_.roster = {{.id = SimulatorId("beta"),
                      .run = 3,
                      .name = "beta",
                      .granted = Instant::FromNanoseconds(5'000'000'000)},
                     {.id = SimulatorId("gamma"), .run = 1, .name = "gamma", .granted = {}}};
  }
  ~SilenceReplayTest() override { std::remove(path_.c_str()); }

  static v1::Input Near(const std::string& name, double x) {
    v1::AgentState state = State(0, 0, 1);
    state.mutable_position_m()->set_x(x);
    return From(name[0], state, name);
  }

  const std::string path_ = testing::TempDir() + "silence_replay." + std::to_string(getpid());
  v1::Config config_;
  ClaimOptions claim_;
};

TEST_F(SilenceReplayTest, TheRosterIsReadBack) {
  { RecordingWriter writer(path_, config_, claim_); }
  EXPECT_EQ(RecordingReader(path_).claim().roster, claim_.roster);
}

TEST_F(SilenceReplayTest, EveryOutputComesAgain) {
  std::vector<v1::Output> recorded;
  std::size_t because = 0;
  {
    RecordingWriter writer(path_, config_, claim_);
    ScriptedDaemon daemon(config_, DaemonParts{.recorder = &writer, .claim = claim_});
    daemon.bus().earliest_read_by = 0;
    for (const char* name : {"alpha", "delta", "omega"}) {
      daemon.Step({From(name[0], Description(name, 0)), Near(name, name[0] * 0.5),
                   From(name[0], ClockAfter(name, 0, 1, 1))},
                  0.01);
    }
    daemon.Pass(9);  // nobody of the roster has come
    daemon.bus().earliest_read_by = 1;
    daemon.Step({Liveliness('d', "delta", false)}, 0.01);
    daemon.Pass(9);
    daemon.Step({}, 9);  // it stands still
    daemon.Pass(12);
    daemon.Step({Command(1, v1::OPERATOR_EVICT, "alpha")}, 0.01);
    daemon.Step({Command(2, v1::OPERATOR_RESTART_TIME)}, 0.01);
    recorded = daemon.bus().outputs;
    for (const v1::Output& output : recorded) {
      because += output.collision_event().extensions_size() > 0;
    }
    ASSERT_EQ(daemon.counter("simulators_removed_silent"), 1u);
  }
  EXPECT_GT(because, 0u);
  std::vector<v1::Output> replayed;
  RecordingReader reader(path_);
  ReplaySource source(reader, [&](const v1::Output& output) { replayed.push_back(output); });
  Daemon daemon(reader.config(), source, source, {.claim = reader.claim()});
  while (daemon.Step()) {
  }
  ASSERT_GE(replayed.size(), recorded.size());
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    ASSERT_EQ(replayed[i].DebugString(), recorded[i].DebugString()) << "output " << i;
  }
}

}  // namespace
}  // namespace collision::server
