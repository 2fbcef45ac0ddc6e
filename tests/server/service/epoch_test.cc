// Goal:   a service that runs for weeks serves one run after the other, each as if it were the
//         first.
// Method: the same run, of two agents that pass through each other, several times against one
//         daemon, with every way in which a run may end and the next one begin.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/scripted_bus.h"
#include "tests/server/service/voyage.h"

namespace collision::server {
namespace {

class EpochTest : public testing::Test {
 protected:
  explicit EpochTest(v1::Clock::OnSilent on_silent = v1::Clock::WAIT)
      : daemon_(VoyageConfig(on_silent)) {}

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

}  // namespace
}  // namespace collision::server
