// Goal:   the service lives through everything that happens to its wall clock: what was promised
//         holds, or is told to be void, and afterwards it answers as before.
// Method: a daemon with clocks that the test sets, and a simulator on the same machine, whose two
//         agents close in on each other; its stamps come from the same wall clock.
#include <gtest/gtest.h>

#include <set>

#include "server/recording/recording.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kStepNs = kSecond / 10;
constexpr std::int64_t kSkewNs = 2'000'000;
constexpr std::uint64_t kSender = 10;

v1::Config Wall() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_skew_max_s(1e-9 * kSkewNs);
  return config;
}

class WallClockTest : public testing::Test {
 protected:
  WallClockTest() : daemon_(Wall()) {}

  /// The simulator tells where its agents are now, a tenth of a second later.
  void Tell(bool with_descriptions = false) {
    daemon_.bus().Pass(kStepNs);
    elapsed_s_ += 1e-9 * kStepNs;
    std::vector<v1::Input> inputs;
    for (std::uint32_t slot : {0, 1}) {
      if (with_descriptions) inputs.push_back(From(kSender, Description("alpha", slot)));
      v1::AgentState state = State(slot, daemon_.bus().wall_ns, ++sequence_);
      state.mutable_position_m()->set_x(slot == 0 ? 0 : 32 - 6 * elapsed_s_);
      state.mutable_velocity_m_s()->set_x(slot == 0 ? 0 : -6);
      inputs.push_back(From(kSender, state, "alpha"));
    }
    v1::SimulatorClock clock = ClockAfter("alpha", daemon_.bus().wall_ns, sequence_, 2);
    clock.set_lock_step(false);
    inputs.push_back(From(kSender, clock));
    daemon_.Step(inputs);
  }
  void TellUntil(double elapsed_s) {
    while (elapsed_s_ < elapsed_s - 0.05) Tell();
  }

  /// The administrator, or NTP, sets the clock of the machine.
  void Set(std::int64_t by_ns) {
    daemon_.bus().wall_ns += by_ns;
    daemon_.bus().wall_was_set = true;
  }

  std::set<v1::EventStatus> EventsOf(std::uint32_t epoch) {
    std::set<v1::EventStatus> statuses;
    for (const v1::Output& output : daemon_.bus().outputs) {
      if (!output.has_collision_event()) continue;
      if (output.collision_event().stamp().epoch() != epoch) continue;
      statuses.insert(output.collision_event().status());
    }
    return statuses;
  }
  v1::Clearance clearance() const { return daemon_.clearance(SimulatorId("alpha")); }
  v1::CollisionEvent LastEvent() {
    for (auto output = daemon_.bus().outputs.rbegin(); output != daemon_.bus().outputs.rend();
         ++output) {
      if (output->has_collision_event()) return output->collision_event();
    }
    throw std::logic_error("no event");
  }

  ScriptedDaemon daemon_;
  double elapsed_s_ = 0;  ///< The agents touch after 5 s.
  std::uint64_t sequence_ = 0;
};

/// A step begins a new epoch, in which the contact is found as if nothing had been before.
class WallClockStepTest : public WallClockTest, public testing::WithParamInterface<std::int64_t> {};

TEST_P(WallClockStepTest, VoidsWhatWasPromisedAndTheContactIsFoundAllTheSame) {
  Tell(true);
  TellUntil(4);
  ASSERT_EQ(EventsOf(1), std::set({v1::EVENT_POSSIBLE}));
  Set(GetParam());
  daemon_.Step({});
  EXPECT_EQ(clearance().stamp().epoch(), 2u);
  EXPECT_EQ(clearance().agents_size(), 0) << "no promise of the former epoch stands";
  EXPECT_EQ(EventsOf(1), std::set({v1::EVENT_POSSIBLE, v1::EVENT_WITHDRAWN}));
  const std::int64_t set_at_ns = daemon_.bus().wall_ns;
  Tell();
  ASSERT_EQ(clearance().agents_size(), 2) << "their descriptions are known";
  EXPECT_EQ(clearance().agents(0).effective_from_ns(), daemon_.bus().wall_ns);
  TellUntil(5.5);
  EXPECT_EQ(EventsOf(2), std::set({v1::EVENT_POSSIBLE, v1::EVENT_CONFIRMED}));
  // 4 s had passed, and a contact begins at 5 s.
  EXPECT_LE(LastEvent().begin().earliest_ns(), set_at_ns + kSecond + kSkewNs);
  EXPECT_GE(LastEvent().begin().latest_ns(), set_at_ns + kSecond - kSkewNs);
  EXPECT_TRUE(daemon_.rejections().empty());
  EXPECT_EQ(daemon_.counter("clock_steps"), 1u);
  EXPECT_EQ(daemon_.counter("breaches"), 0u);
}

INSTANTIATE_TEST_SUITE_P(Steps, WallClockStepTest,
                         testing::Values(5 * kSecond, -12 * kSecond, 3600 * kSecond,
                                         -3600 * kSecond, 2 * kSkewNs));

// Until the clock has passed the end of the former epoch, old and new stamps look alike.
TEST_F(WallClockTest, AfterASmallStepBackAgentsComeBackOnceStampsCannotBeOld) {
  Tell(true);
  TellUntil(1);
  Set(-kSecond / 4);
  daemon_.Step({});
  for (int i = 0; i < 2; ++i) Tell();
  EXPECT_EQ(clearance().agents_size(), 0);
  ASSERT_FALSE(daemon_.rejections().empty());
  EXPECT_EQ(daemon_.rejections().back().reason(), v1::REJECTED_STALE);
  for (int i = 0; i < 2; ++i) Tell();
  EXPECT_EQ(clearance().agents_size(), 2);
}

TEST_F(WallClockTest, AStepWithinTheSkewVoidsNothing) {
  for (const std::int64_t by_ns : {kSkewNs / 2, -kSkewNs / 2}) {
    Tell(true);
    TellUntil(elapsed_s_ + 0.5);
    Set(by_ns);
    Tell();
    EXPECT_EQ(clearance().stamp().epoch(), 1u);
    EXPECT_EQ(clearance().agents_size(), 2);
  }
  EXPECT_EQ(daemon_.counter("clock_steps"), 2u);
  EXPECT_EQ(daemon_.counter("breaches"), 0u);
  EXPECT_TRUE(daemon_.rejections().empty());
}

TEST_F(WallClockTest, AMachineThatSleptFindsThatBoundsHaveGrown) {
  Tell(true);
  Tell();
  ASSERT_FALSE(clearance().agents(0).not_clear());
  daemon_.bus().Pass(60 * kSecond);
  daemon_.bus().wall_was_set = true;
  daemon_.Step({});
  EXPECT_EQ(clearance().stamp().epoch(), 1u);
  EXPECT_TRUE(clearance().agents(0).not_clear());
  EXPECT_EQ(daemon_.counter("clock_steps"), 0u);
}

TEST_F(WallClockTest, SlewingIsFollowed) {
  Tell(true);
  for (int i = 0; i < 300; ++i) {
    daemon_.bus().wall_ns += kStepNs / 2000;  // 500 ppm: 15 ms in all
    Tell();
  }
  EXPECT_EQ(clearance().stamp().epoch(), 1u);
  EXPECT_TRUE(daemon_.rejections().empty()) << "stamps follow the clock, and so does the service";
  EXPECT_EQ(daemon_.status().now_ns(), daemon_.bus().wall_ns);
  EXPECT_EQ(daemon_.counter("clock_steps"), 0u);
}

/// Keeps what it gets.
class BatchList final : public BatchSink {
 public:
  bool Record(const v1::RecordedBatch& batch) override {
    batches.push_back(batch);
    return true;
  }
  std::string error() const override { return {}; }
  std::vector<v1::RecordedBatch> batches;
};

TEST_F(WallClockTest, AReplayFollowsTheSameSteps) {
  BatchList record;
  ScriptedDaemon recorded(Wall(), &record);
  const auto tell = [&](int step, std::int64_t set_ns) {
    recorded.bus().wall_ns += set_ns;
    recorded.bus().wall_was_set = set_ns != 0;
    recorded.bus().Pass(kStepNs);
    std::vector<v1::Input> inputs;
    for (std::uint32_t slot : {0, 1}) {
      if (step == 0) inputs.push_back(From(kSender, Description("alpha", slot)));
      v1::AgentState state = State(slot, recorded.bus().wall_ns, 2 * step + slot + 1);
      state.mutable_position_m()->set_x(slot == 0 ? 0 : 6 - 0.3 * step);
      state.mutable_velocity_m_s()->set_x(slot == 0 ? 0 : -3);
      inputs.push_back(From(kSender, state, "alpha"));
    }
    recorded.Step(inputs);
  };
  for (int step = 0; step < 20; ++step) tell(step, step == 5 ? -kSecond * 3 / 2 : 0);
  ScriptedDaemon replayed(Wall());
  for (const v1::RecordedBatch& batch : record.batches) {
    replayed.bus().wall_ns = batch.wall_ns();
    replayed.bus().monotonic_ns = batch.monotonic_ns();
    replayed.bus().wall_was_set = batch.wall_was_set();
    replayed.Step({batch.inputs().begin(), batch.inputs().end()});
  }
  EXPECT_GT(recorded.daemon().event_log().count(), 2u);
  EXPECT_EQ(replayed.daemon().event_log().hash(), recorded.daemon().event_log().hash());
}

TEST_F(WallClockTest, AServiceThatStartsBeforeTheClockIsSetServesOnceItIs) {
  const std::int64_t true_ns = daemon_.bus().wall_ns;
  daemon_.bus().wall_ns = 40 * kSecond;  // 1970
  daemon_.Step({});
  daemon_.bus().wall_ns = true_ns;
  Tell(true);
  TellUntil(5.5);
  EXPECT_EQ(EventsOf(2), std::set({v1::EVENT_POSSIBLE, v1::EVENT_CONFIRMED}));
  EXPECT_EQ(daemon_.daemon().event_log().count() > 0, true);
  const v1::ServiceStatus status = daemon_.status();
  std::string step;
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == "clock_step") step = extension.value();
  }
  EXPECT_NE(step.find("by +1699999960.0"), std::string::npos) << step;
}

}  // namespace
}  // namespace collision::server
