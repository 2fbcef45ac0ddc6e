// Goal:   a simulator that held time and starts again is waited for until it has told a clock, so
//         that the others are granted nothing past contacts with it, and time does not end without
//         it; named, released and evicted it is as any other.
//         Where nobody else holds time, its next run begins a new time.
// Method: a daemon of which the test writes every step: the messages of the new program arrive one
//         at a time, as they may.
#include <gtest/gtest.h>

#include <tuple>
#include <utility>
#include <vector>

#include "idl/identity.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMinute = 60 * kSecond;

/// Two simulators without agents in each other's way, and with long steps; beta dies, and its next
/// program has told nothing but its agent.
class StartedAgainTest : public testing::Test {
 protected:
  explicit StartedAgainTest(v1::Clock::OnSilent on_silent = v1::Clock::WAIT)
      : daemon_(OfTwoSimulators(on_silent)) {
    for (const auto& [sender, name, x] :
         {std::tuple(1, "alpha", 0.0), std::tuple(2, "beta", 1e6)}) {
      v1::AgentState state = State(0, 0, 1);
      state.mutable_position_m()->set_x(x);
      v1::SimulatorClock clock = ClockAfter(name, 0, 1, 1);
      clock.set_next_ns(sender * kMinute);
      daemon_.Step(
          {From(sender, Description(name, 0)), From(sender, state, name), From(sender, clock)},
          0.01);
    }
    daemon_.Step({Liveliness(2, "beta", false)}, 0.01);
    daemon_.Step({From(12, Description("beta", 0, 2))}, 0.01);
  }

  /// What time is it?
  static v1::SimulatorClock Asks(const std::string& name, std::uint32_t run) {
    return ClockOf(name, Instant::Always().nanoseconds(), run);
  }

  /// Alpha has reached this time; its next step is a second later.
  void AlphaReaches(std::int64_t clock_ns) {
    v1::SimulatorClock clock = ClockAfter("alpha", clock_ns, 1, 1);
    clock.set_next_ns(clock_ns + kSecond);
    daemon_.Step({From(1, clock)}, 0.01);
  }

  std::int64_t granted_ns(const std::string& name) {
    return daemon_.clearance(SimulatorId(name)).granted_until_ns();
  }

  // A status takes a second.
  std::int64_t now_ns() { return daemon_.status().now_ns(); }
  std::uint32_t epoch() { return daemon_.status().stamp().epoch(); }
  std::string waiting_for() { return Extension(daemon_.status(), "waiting_for"); }

  mutable ScriptedDaemon daemon_;
};

class StartedAgainReleaseTest : public StartedAgainTest {
 protected:
  StartedAgainReleaseTest() : StartedAgainTest(v1::Clock::RELEASE) {}
};

TEST_F(StartedAgainTest, TheOthersAreGrantedNothingBeforeItsFirstClock) {
  const std::int64_t granted = granted_ns("alpha");
  ASSERT_GT(granted, kSecond);
  AlphaReaches(granted);
  EXPECT_LT(now_ns(), granted);
  EXPECT_EQ(granted_ns("alpha"), granted);
  // It asks what time it is, and is told.
  daemon_.Step({From(12, Asks("beta", 2))}, 0.01);
  EXPECT_EQ(granted_ns("beta"), granted);
  EXPECT_EQ(granted_ns("alpha"), granted) << "it has not said when its first step is";
  v1::SimulatorClock clock = ClockAfter("beta", granted, 0, 1);
  clock.set_run(2);
  clock.set_next_ns(granted + kSecond);
  daemon_.Step({From(12, clock)}, 0.01);
  EXPECT_EQ(now_ns(), granted) << "both have told everything before it";
  EXPECT_EQ(epoch(), 1u);
}

TEST_F(StartedAgainTest, TimeDoesNotEndBeforeItHasToldAClock) {
  daemon_.Step({Liveliness(1, "alpha", false), Command(1, v1::OPERATOR_EVICT, "alpha")}, 0.01);
  EXPECT_EQ(epoch(), 1u) << "nobody else holds time";
  daemon_.Step({Command(2, v1::OPERATOR_EVICT, "beta")}, 0.01);
  EXPECT_EQ(epoch(), 2u);
}

// It was never in the world: nobody has promised it anything.
TEST_F(StartedAgainTest, WhoLeavesInGoodOrderIsNotWaitedFor) {
  daemon_.Step({Removal(12, "beta", 0)}, 0.01);
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  const std::int64_t granted = granted_ns("alpha");
  AlphaReaches(granted);
  EXPECT_GT(granted_ns("alpha"), granted);
}

TEST_F(StartedAgainTest, WhoOnlyAsksAndDiesIsWaitedFor) {
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({From(22, Asks("beta", 3))}, 0.01);
  const std::int64_t granted = granted_ns("beta");
  daemon_.Step({Liveliness(22, "beta", false)}, 0.01);
  AlphaReaches(granted);
  EXPECT_EQ(granted_ns("alpha"), granted);
  EXPECT_EQ(waiting_for(), "beta");
  daemon_.Step({Command(1, v1::OPERATOR_EVICT, "beta")}, 0.01);
  EXPECT_EQ(waiting_for(), "");
  EXPECT_GT(granted_ns("alpha"), granted);
}

TEST_F(StartedAgainTest, WithAClockAndWithoutAgentsItsEndIsNobodysConcern) {
  const std::int64_t granted = granted_ns("alpha");
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  v1::SimulatorClock clock = ClockAfter("beta", granted, 0, 0);
  clock.set_run(3);
  daemon_.Step({From(22, clock)}, 0.01);
  daemon_.Step({Liveliness(22, "beta", false)}, 0.01);
  AlphaReaches(granted);
  AlphaReaches(granted_ns("alpha"));
  EXPECT_GT(granted_ns("alpha"), granted + 2 * kSecond);
}

TEST_F(StartedAgainTest, InTimeThatBeginsAnewItIsANewcomer) {
  daemon_.Step({Command(1, v1::OPERATOR_RESTART_TIME)}, 0.01);
  EXPECT_EQ(epoch(), 2u);
  EXPECT_EQ(daemon_.status().granted_until_ns(), Instant::Always().nanoseconds());
  EXPECT_EQ(waiting_for(), "");
}

TEST_F(StartedAgainTest, BesideADeadOneItHoldsThisTime) {
  const std::int64_t granted = granted_ns("alpha");
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({Liveliness(1, "alpha", false)}, 0.01);
  daemon_.Step({From(11, Description("alpha", 0, 2)), From(11, Asks("alpha", 2))}, 0.01);
  EXPECT_EQ(epoch(), 1u);
  EXPECT_EQ(granted_ns("alpha"), granted);
  EXPECT_EQ(waiting_for(), "beta");
}

// Goal:   nobody is left who knows this time, so the world begins anew, whether the clock of the
//         new run comes with its agent or later.
TEST(StartedAgainAlone, ItsNextRunBeginsTheNextEpoch) {
  v1::Config config = OfTwoSimulators(v1::Clock::WAIT);
  config.mutable_clock()->set_simulators_awaited(1);
  ScriptedDaemon daemon(config);
  daemon.Step({From(1, Description("alpha", 0)), From(1, ClockAfter("alpha", kSecond, 0, 1))});
  for (std::uint32_t run : {2, 3}) {
    daemon.Step({Liveliness(run - 1, "alpha", false)}, 0.01);
    EXPECT_EQ(daemon.status().stamp().epoch(), run - 1);
    v1::SimulatorClock clock = ClockAfter("alpha", kSecond, 0, 1);
    clock.set_run(run);
    std::vector<v1::Input> told = {From(run, Description("alpha", 0, run))};
    if (run == 2) daemon.Step(std::exchange(told, {}), 0.01);
    told.push_back(From(run, clock));
    daemon.Step(told, 0.01);
    EXPECT_EQ(daemon.status().stamp().epoch(), run);
    EXPECT_EQ(daemon.status().now_ns(), kSecond);
  }
}

// Goal:   a program that has been replaced and goes on claims nothing: once its successor dies,
//         that one is waited for.
TEST(StartedAgainAlone, AProgramOfALowerRunIsNoSuccessor) {
  v1::Config config = OfTwoSimulators(v1::Clock::WAIT);
  config.mutable_clock()->set_simulators_awaited(1);
  ScriptedDaemon daemon(config);
  for (const std::uint32_t run : {2, 1}) {
    v1::SimulatorClock clock = ClockAfter("alpha", kSecond, 0, 1);
    clock.set_run(run);
    daemon.Step({From(run, Description("alpha", 0, run)), From(run, clock)}, 0.01);
  }
  daemon.Step({Liveliness(2, "alpha", false)}, 0.01);
  EXPECT_EQ(daemon.status().stamp().epoch(), 1u);
}

// Goal:   nor does a service end an epoch that has only not heard yet who is there.
TEST(StartedAgainAlone, AServiceThatStoodStillListensBeforeItEndsTheEpoch) {
  v1::Config config = OfTwoSimulators(v1::Clock::WAIT);
  config.mutable_clock()->set_simulators_awaited(1);
  ScriptedDaemon daemon(config);
  daemon.Step({From(1, Description("alpha", 0)), From(1, ClockAfter("alpha", kSecond, 0, 1))});
  daemon.Step({Liveliness(1, "alpha", false)}, 5);
  daemon.Step({From(2, Description("alpha", 0, 2))}, 0.5);
  EXPECT_EQ(daemon.status().stamp().epoch(), 1u);
}

TEST_F(StartedAgainTest, WhoHasJustAskedKeepsTheEpoch) {
  daemon_.Step({Liveliness(12, "beta", false), Command(1, v1::OPERATOR_EVICT, "beta")}, 0.01);
  daemon_.Step({Liveliness(1, "alpha", false)}, 0.01);
  // A batch is in the order of ids.
  ASSERT_LT(SimulatorId("gamma"), SimulatorId("alpha"));
  daemon_.Step({From(30, Asks("gamma", 1)), From(11, Description("alpha", 0, 2))}, 0.01);
  EXPECT_EQ(epoch(), 1u);
}

TEST_F(StartedAgainTest, IsNamedOnceItTakesLongAndOnceItHasDiedAgain) {
  const auto why = [&] { return Extension(daemon_.status(), "waiting_why"); };
  const std::int64_t granted = granted_ns("alpha");
  AlphaReaches(granted);  // It may go no further.
  // What else it tells brings the world no further.
  for (std::uint32_t revision : {2, 3, 4}) {
    v1::AgentDescription description = Description("beta", 0, 2);
    description.set_revision(revision);
    daemon_.Step({From(12, description)}, 0.6);
  }
  EXPECT_EQ(waiting_for(), "") << "2.8 s";
  // The bus is asked to wake the daemon when a name is due.
  daemon_.Step({}, 0.01);
  EXPECT_LE(daemon_.bus().timeout_ns, 200'000'000);
  EXPECT_EQ(waiting_for(), "beta");
  EXPECT_EQ(why(), "beta: has started again, and no clock of it has been accepted yet");
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({}, 0.5);
  EXPECT_EQ(why(), "beta: not heard for more than 1 s");
  daemon_.Pass(30);
  EXPECT_EQ(waiting_for(), "beta") << "one that the world waits for is not removed";
  EXPECT_EQ(granted_ns("alpha"), granted);
  daemon_.Step({Command(1, v1::OPERATOR_EVICT, "beta")}, 0.01);
  EXPECT_EQ(waiting_for(), "");
  EXPECT_GT(granted_ns("alpha"), granted);
}

TEST_F(StartedAgainReleaseTest, IsReleasedByItsOwnTime) {
  const std::int64_t granted = granted_ns("alpha");
  AlphaReaches(granted);
  daemon_.Pass(7.9);
  EXPECT_EQ(granted_ns("alpha"), granted);
  daemon_.Pass(0.2);
  const std::int64_t released = granted_ns("alpha");
  EXPECT_GT(released, granted);
  // Once released, nobody waits for its next program.
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({From(22, Description("beta", 0, 3))}, 0.01);
  AlphaReaches(released);
  EXPECT_GT(granted_ns("alpha"), released);
}

TEST_F(StartedAgainReleaseTest, OnceReleasedTheDeadHaveLeft) {
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({From(22, Asks("beta", 3))}, 0.01);
  daemon_.Step({Liveliness(22, "beta", false)}, 0.01);
  EXPECT_EQ(daemon_.status().simulators_size(), 2);
  daemon_.Pass(9);
  EXPECT_EQ(daemon_.status().simulators_size(), 1);
}

TEST_F(StartedAgainTest, ADeadOneDoesNotGoOnInTimeThatBeginsAnew) {
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({Command(1, v1::OPERATOR_RESTART_TIME)}, 0.01);
  const std::string answer = Extension(daemon_.status(), "operator." + IdText(1));
  EXPECT_TRUE(
      answer.ends_with("with a higher run: 2; others, which had told no clock and go on: 0"))
      << answer;
}

TEST_F(StartedAgainReleaseTest, HoldsTimeAgainOnceItAsks) {
  AlphaReaches(granted_ns("alpha"));
  daemon_.Pass(8.1);
  const std::int64_t released = granted_ns("alpha");
  daemon_.Step({From(12, Asks("beta", 2))}, 0.01);
  EXPECT_EQ(granted_ns("beta"), released);
  AlphaReaches(released);
  EXPECT_EQ(granted_ns("alpha"), released);
}

TEST_F(StartedAgainTest, WhoHadTakenItsLastStepIsNotWaitedFor) {
  v1::SimulatorClock last = ClockAfter("beta", granted_ns("alpha"), 0, 1);
  last.set_run(2);
  last.set_next_ns(kNeverNs);
  daemon_.Step({From(12, last)}, 0.01);
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({From(22, Description("beta", 0, 3))}, 0.01);
  const std::int64_t granted = granted_ns("alpha");
  AlphaReaches(granted);
  EXPECT_GT(granted_ns("alpha"), granted);
  daemon_.Step({Liveliness(1, "alpha", false), Command(1, v1::OPERATOR_EVICT, "alpha")}, 0.01);
  EXPECT_EQ(epoch(), 2u) << "nor does time go on for it";
}

TEST(StartedAgainBeforeTimeBegan, IsOneOfThoseAwaited) {
  ScriptedDaemon daemon(OfTwoSimulators(v1::Clock::WAIT));
  daemon.Step({From(1, Description("alpha", 0)), From(1, ClockAfter("alpha", kSecond, 0, 1))});
  daemon.Step({Liveliness(1, "alpha", false)}, 0.01);
  daemon.Step({From(11, Description("alpha", 0, 2))}, 0.01);
  EXPECT_EQ(daemon.status().granted_until_ns(), Instant::Always().nanoseconds());
  EXPECT_EQ(daemon.status().now_ns(), 0);
}

// Goal:   the agents of a dead program that limited the others' time go with it, and that time is
//         granted no further all the same.
TEST(StartedAgainNearOthers, TheirGrantStands) {
  ScriptedDaemon daemon(OfTwoSimulators(v1::Clock::WAIT));
  for (const auto& [sender, name, x] : {std::tuple(1, "alpha", -5.0), std::tuple(2, "beta", 5.0)}) {
    v1::AgentState state = State(0, 0, 1);
    state.mutable_position_m()->set_x(x);
    state.mutable_velocity_m_s()->set_x(-x);
    daemon.Step({From(sender, Description(name, 0)), From(sender, state, name),
                 From(sender, ClockAfter(name, 0, 1, 1))},
                0.01);
  }
  const auto granted = [&] { return daemon.clearance(SimulatorId("alpha")).granted_until_ns(); };
  const std::int64_t before = granted();
  ASSERT_LT(before, kSecond);
  daemon.Step({Liveliness(2, "beta", false)}, 0.01);
  daemon.Step({From(12, Description("beta", 0, 2))}, 0.01);
  daemon.Step({From(1, ClockAfter("alpha", before, 1, 1))}, 0.01);
  EXPECT_EQ(granted(), before);
}

}  // namespace
}  // namespace collision::server
