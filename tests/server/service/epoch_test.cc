// Goal:   a service that runs for weeks serves one run after the other, each as if it were the
//         first.
// Method: the same run, of two agents that pass through each other, several times against one
//         daemon, with every way in which a run may end and the next one begin.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kTenth = 100'000'000;  ///< [ns] The step of the simulator.
constexpr int kSteps = 10;

v1::Config Config(v1::Clock::OnSilent on_silent = v1::Clock::WAIT) {
  v1::Config config = Simulated();
  config.set_temporal_resolution_s(0.1);
  config.mutable_clock()->set_on_silent_simulator(on_silent);
  if (on_silent == v1::Clock::RELEASE) config.mutable_clock()->set_release_after_s(0.5);
  return config;
}

/// One run of one simulator with two agents that touch from 0.4 to 0.6 s after its first clock.
struct Voyage {
  std::string simulator = "alpha";
  std::uint64_t sender = 1;
  std::uint32_t run = 1;
  std::int64_t first_clock_ns = 0;

  v1::AgentState StateOf(std::uint32_t slot, int step) const {
    const std::int64_t stamp_ns = first_clock_ns + step * kTenth;
    v1::AgentState state = State(slot, stamp_ns, 2 * static_cast<std::uint64_t>(step) + slot + 1);
    const double direction = slot == 0 ? 1 : -1;
    state.mutable_position_m()->set_x(direction * (-5 + step));
    state.mutable_velocity_m_s()->set_x(direction * 10);
    return state;
  }

  std::vector<v1::Input> Told(int step) const {
    std::vector<v1::Input> inputs;
    for (std::uint32_t slot : {0, 1}) {
      if (step == 0) inputs.push_back(From(sender, Description(simulator, slot, run)));
      inputs.push_back(From(sender, StateOf(slot, step), simulator, run));
    }
    v1::SimulatorClock clock = ClockAfter(simulator, first_clock_ns + step * kTenth,
                                          2 * static_cast<std::uint64_t>(step) + 2, 2);
    clock.set_run(run);
    inputs.push_back(From(sender, clock));
    return inputs;
  }

  std::vector<v1::Input> Removals() const {
    return {Removal(sender, simulator, 0), Removal(sender, simulator, 1)};
  }
  v1::Input End() const { return Liveliness(sender, simulator, false); }
};

std::vector<v1::Input> Joined(std::vector<v1::Input> a, const std::vector<v1::Input>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class EpochTest : public testing::Test {
 protected:
  explicit EpochTest(v1::Clock::OnSilent on_silent = v1::Clock::WAIT)
      : daemon_(Config(on_silent)) {}

  /// From the step `first` to the last.
  void Fly(const Voyage& run, int first = 0) {
    for (int step = first; step <= kSteps; ++step) daemon_.Step(run.Told(step), 0.01);
  }

  /// The events since the last call, without what differs between runs.
  std::vector<std::string> TakeEvents() {
    std::vector<std::string> events;
    for (; taken_ < daemon_.bus().outputs.size(); ++taken_) {
      const v1::Output& output = daemon_.bus().outputs[taken_];
      if (!output.has_collision_event()) continue;
      v1::CollisionEvent event = output.collision_event();
      event.clear_stamp();
      event.clear_contacts_sequence();
      event.mutable_lower()->clear_run();
      event.mutable_higher()->clear_run();
      events.push_back(event.ShortDebugString());
    }
    return events;
  }

  std::uint32_t epoch() { return daemon_.status().stamp().epoch(); }

  ScriptedDaemon daemon_;
  std::size_t taken_ = 0;
};

class EpochReleaseTest : public EpochTest {
 protected:
  EpochReleaseTest() : EpochTest(v1::Clock::RELEASE) {}
};

TEST_F(EpochTest, TheSameRunThreeTimesGetsTheSameEventsThreeTimes) {
  Voyage run;
  Fly(run);
  daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
  const std::vector<std::string> events = TakeEvents();
  ASSERT_GE(events.size(), 3u);
  EXPECT_NE(events.back().find("EVENT_ENDED"), std::string::npos);
  for (std::uint32_t again : {2, 3}) {
    EXPECT_EQ(epoch(), again);
    run.sender = run.run = again;
    Fly(run);
    daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
    EXPECT_EQ(TakeEvents(), events) << "run " << again;
  }
  EXPECT_TRUE(daemon_.rejections().empty());
}

TEST_F(EpochTest, TheEndAndTheNextBeginningMayComeTogether) {
  const Voyage first, second{.sender = 2, .run = 2};
  Fly(first);
  const std::vector<v1::Input> end = Joined(first.Removals(), {first.End()});
  daemon_.Step(Joined(end, second.Told(0)), 0.01);
  const std::vector<std::string> events = TakeEvents();
  EXPECT_EQ(epoch(), 2u);
  // What came before the end was refused: it is told again.
  Fly(second);
  daemon_.Step(Joined(second.Removals(), {second.End()}), 0.01);
  EXPECT_EQ(TakeEvents(), events);
}

TEST_F(EpochTest, AfterACrashTheSuccessorThatWaitsBeginsAnew) {
  const Voyage first, second{.sender = 2, .run = 2};
  Fly(first);
  daemon_.Step(second.Told(0), 0.01);  // within the lease: refused
  EXPECT_EQ(epoch(), 1u);
  TakeEvents();
  daemon_.Step({first.End()}, 0.01);
  EXPECT_EQ(epoch(), 2u);
  daemon_.Step(second.Told(0), 0.01);
  EXPECT_EQ(daemon_.clearance(SimulatorId("alpha")).now_ns(), 0);
  Fly(second, 1);
  daemon_.Step(Joined(second.Removals(), {second.End()}), 0.01);
  const std::vector<std::string> events = TakeEvents();
  EXPECT_NE(events.back().find("EVENT_ENDED"), std::string::npos);
}

TEST_F(EpochTest, TheDeadWithoutASuccessorIsWaitedForAndTheEpochStays) {
  const Voyage run;
  Fly(run);
  daemon_.Step({run.End()}, 0.01);
  daemon_.Step({}, 3600);
  EXPECT_EQ(epoch(), 1u);
}

TEST_F(EpochReleaseTest, WhenTheLastOneIsReleasedItsAgentsAreGone) {
  const Voyage run;
  Fly(run);
  daemon_.Step({run.End()}, 0.01);
  EXPECT_EQ(daemon_.daemon().event_log().count() > 0, true);
  daemon_.Step({}, 0.6);
  daemon_.Step({}, 0.01);
  const v1::ServiceStatus status = daemon_.status();
  EXPECT_EQ(status.stamp().epoch(), 2u);
  EXPECT_EQ(status.agents(), 0u);
}

TEST_F(EpochTest, AsLongAsOneHoldsTimeTheEpochStays) {
  const Voyage alpha, beta{.simulator = "beta", .sender = 5};
  daemon_.Step(alpha.Told(0), 0.01);
  daemon_.Step(beta.Told(0), 0.01);
  for (int step = 1; step <= 5; ++step) {
    daemon_.Step(Joined(alpha.Told(step), beta.Told(step)), 0.01);
  }
  daemon_.Step(Joined(alpha.Removals(), {alpha.End()}), 0.01);
  const Voyage again{.sender = 2, .run = 2, .first_clock_ns = 5 * kTenth};
  daemon_.Step(again.Told(0), 0.01);
  EXPECT_EQ(epoch(), 1u);
  daemon_.Step(Joined(beta.Removals(), {beta.End()}), 0.01);
  EXPECT_EQ(epoch(), 1u) << "alpha has come back in time";
}

TEST_F(EpochTest, AFirstClockBeyondTheBoundIsRefusedAndHarmsNobody) {
  const Voyage wrong{
      .simulator = "wrong", .sender = 9, .first_clock_ns = 1'700'000'000'000'000'000};
  daemon_.Step(wrong.Told(0), 0.01);
  ASSERT_FALSE(daemon_.rejections().empty());
  daemon_.Step(Joined(wrong.Removals(), {wrong.End()}), 0.01);
  const Voyage run;
  Fly(run);
  daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
  const std::vector<std::string> events = TakeEvents();
  ASSERT_FALSE(events.empty());
  EXPECT_NE(events.back().find("EVENT_ENDED"), std::string::npos);
}

TEST_F(EpochTest, AnEpochMayBeginAtAnyTime) {
  Voyage run{.first_clock_ns = 20 * 1'000'000'000LL};
  Fly(run);
  daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
  ASSERT_FALSE(TakeEvents().empty());
  run = {.sender = 2, .run = 2, .first_clock_ns = 1'000'000'000};
  Fly(run);
  EXPECT_EQ(daemon_.clearance(SimulatorId("alpha")).now_ns(), 2'000'000'000);
}

// Readers and standbys compare epochs of different services.
TEST(EpochOfAStandby, IsThatOfTheServiceBesideIt) {
  ScriptedDaemon daemon(Config(), {.claim = {.instance = 2, .stands_by = true}});
  const auto hear = [&](std::uint32_t epoch, std::uint64_t sequence) {
    v1::Input input;
    v1::ServiceHeard& heard = *input.mutable_service_heard();
    heard.set_service_id(1);
    heard.set_term(1);
    heard.set_phase(v1::PHASE_SERVING);
    heard.set_epoch(epoch);
    heard.set_sequence(sequence);
    daemon.Step({input});
  };
  hear(3, 1);
  EXPECT_EQ(daemon.status().phase(), v1::PHASE_STANDBY);
  EXPECT_EQ(daemon.status().stamp().epoch(), 3u);
  hear(4, 2);
  EXPECT_EQ(daemon.status().stamp().epoch(), 4u) << "before time begins";
  hear(2, 3);
  EXPECT_EQ(daemon.status().stamp().epoch(), 4u);
  const Voyage run;
  daemon.Step(run.Told(0), 0.01);
  hear(9, 4);
  EXPECT_EQ(daemon.status().stamp().epoch(), 4u) << "its own time has begun";
}

// Goal:   what the other service granted in an epoch that is over holds nobody in the next one.
TEST(EpochOfAStandby, GrantsOfAnEpochThatIsOverDoNotCount) {
  ScriptedDaemon daemon(Config(), {.claim = {.instance = 2, .stands_by = true}});
  v1::Input heard;
  v1::ServiceHeard& service = *heard.mutable_service_heard();
  service.set_service_id(1);
  service.set_term(1);
  service.set_phase(v1::PHASE_SERVING);
  service.set_epoch(1);
  service.set_granted_until_ns(1000 * 1'000'000'000LL);
  Voyage run;
  daemon.Step({heard});
  daemon.Step(run.Told(0), 0.01);
  daemon.Step(Joined(run.Removals(), {run.End()}), 0.01);
  ASSERT_EQ(daemon.status().stamp().epoch(), 2u);
  run = {.sender = 2, .run = 2};
  daemon.Step(run.Told(0), 0.01);
  service.set_sequence(2);  // of the old epoch, and late
  daemon.Step({heard}, 0.01);
  service.set_ended(true);
  daemon.Step({heard}, 0.01);
  std::vector<v1::Input> told = run.Told(0);
  for (v1::Input& input : told) {
    if (input.has_simulator_clock()) input.mutable_simulator_clock()->set_service_id(2);
  }
  daemon.Step(told, 0.01);
  const v1::Clearance clearance = daemon.clearance(SimulatorId("alpha"));
  ASSERT_GT(clearance.agents_size(), 0);
  EXPECT_LT(clearance.agents(0).effective_from_ns(), 100 * 1'000'000'000LL);
}

// What a standby says whose own cable was out would be wrong.
TEST(ATakeOver, IsSilentButForItsStatusUntilASimulatorFollowsIt) {
  ScriptedDaemon daemon(Config(), {.claim = {.instance = 2, .stands_by = true}});
  v1::Input heard;
  heard.mutable_service_heard()->set_service_id(1);
  heard.mutable_service_heard()->set_term(1);
  heard.mutable_service_heard()->set_phase(v1::PHASE_SERVING);
  daemon.Step({heard});
  const Voyage run;
  daemon.Step(run.Told(0), 0.01);
  heard.mutable_service_heard()->set_ended(true);
  daemon.Step({heard}, 0.01);
  EXPECT_EQ(daemon.status().phase(), v1::PHASE_SERVING);
  EXPECT_EQ(daemon.status().followers(), 0u);
  const auto says_more_than_its_status = [&] {
    return std::any_of(daemon.bus().outputs.begin(), daemon.bus().outputs.end(),
                       [](const v1::Output& output) { return !output.has_service_status(); });
  };
  EXPECT_FALSE(says_more_than_its_status());
  std::vector<v1::Input> told = run.Told(0);
  for (v1::Input& input : told) {
    if (input.has_simulator_clock()) input.mutable_simulator_clock()->set_service_id(2);
  }
  daemon.Step(told, 0.01);
  EXPECT_TRUE(says_more_than_its_status());
  EXPECT_EQ(daemon.status().followers(), 1u);
}

}  // namespace
}  // namespace collision::server
