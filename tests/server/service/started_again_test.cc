// Goal:   a simulator that held time and starts again is waited for until it has told a clock, so
//         that the others are granted nothing past contacts with it, and time does not end without
//         it; named, released and evicted it is as any other.
//         Once all who held time are dead, the first that starts again begins a new time.
// Method: a daemon of which the test writes every step: the messages of the new program arrive one
//         at a time, as they may.
#include <gtest/gtest.h>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

v1::Config Config(v1::Clock::OnSilent on_silent) {
  v1::Config config = Simulated();
  config.mutable_clock()->set_simulators_awaited(2);
  config.mutable_clock()->set_on_silent_simulator(on_silent);
  if (on_silent == v1::Clock::RELEASE) config.mutable_clock()->set_release_after_s(8);
  config.mutable_clock()->set_waiting_after_s(3);
  config.mutable_clock()->set_remove_silent_after_s(20);
  return config;
}

/// Two simulators without agents in each other's way; beta dies, and its next program has told
/// nothing but its agent.
class StartedAgainTest : public testing::Test {
 protected:
  explicit StartedAgainTest(v1::Clock::OnSilent on_silent = v1::Clock::WAIT)
      : daemon_(Config(on_silent)) {
    for (const auto& [sender, name, x] :
         {std::tuple(1, "alpha", 0.0), std::tuple(2, "beta", 1e6)}) {
      v1::AgentState state = State(0, 0, 1);
      state.mutable_position_m()->set_x(x);
      daemon_.Step({From(sender, Description(name, 0)), From(sender, state, name),
                    From(sender, ClockAfter(name, 0, 1, 1))},
                   0.01);
    }
    daemon_.Step({Liveliness(2, "beta", false)}, 0.01);
    daemon_.Step({From(12, Description("beta", 0, 2))}, 0.01);
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
  EXPECT_EQ(now_ns(), 0);
  EXPECT_EQ(granted_ns("alpha"), granted);
  // It asks what time it is, and is told.
  v1::SimulatorClock asks = ClockAfter("beta", Instant::Always().nanoseconds(), 0, 1);
  asks.set_run(2);
  daemon_.Step({From(12, asks)}, 0.01);
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
  AlphaReaches(granted_ns("alpha"));
  EXPECT_GT(now_ns(), 0);
}

TEST_F(StartedAgainTest, WhoOnlyAsksAndDiesIsWaitedFor) {
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  v1::SimulatorClock asks = ClockOf("beta", Instant::Always().nanoseconds(), 3);
  daemon_.Step({From(22, asks)}, 0.01);
  const std::int64_t granted = granted_ns("beta");
  daemon_.Step({Liveliness(22, "beta", false)}, 0.01);
  AlphaReaches(granted);
  EXPECT_EQ(granted_ns("alpha"), granted);
  EXPECT_EQ(waiting_for(), "beta");
}

// Nobody is left who knows this time, so the world begins anew, whatever comes first.
TEST_F(StartedAgainTest, OnceAllHaveDiedTheFirstToStartAgainBeginsTheNextEpoch) {
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({Liveliness(1, "alpha", false)}, 0.01);
  EXPECT_EQ(epoch(), 1u);
  v1::SimulatorClock clock = ClockAfter("alpha", 0, 0, 1);
  clock.set_run(2);
  daemon_.Step({From(11, Description("alpha", 0, 2)), From(11, clock)}, 0.01);
  EXPECT_EQ(epoch(), 2u);
  clock = ClockAfter("beta", 0, 0, 1);
  clock.set_run(3);
  daemon_.Step({From(22, Description("beta", 0, 3)), From(22, clock)}, 0.01);
  EXPECT_EQ(epoch(), 2u);
  EXPECT_GT(granted_ns("alpha"), 0) << "both are there again";
}

TEST_F(StartedAgainTest, IsNamedOnceItTakesLongAndOnceItHasDiedAgain) {
  const auto why = [&] { return Extension(daemon_.status(), "waiting_why"); };
  AlphaReaches(granted_ns("alpha"));  // It may go no further.
  daemon_.Pass(1.9);
  EXPECT_EQ(waiting_for(), "") << "2.9 s";
  // The bus is asked to wake the daemon when a name is due.
  daemon_.Step({}, 0.01);
  EXPECT_LE(daemon_.bus().timeout_ns, 100'000'000);
  EXPECT_EQ(waiting_for(), "beta");
  EXPECT_EQ(why(), "beta: has started again and has told no clock yet");
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({}, 0.5);
  EXPECT_EQ(why(), "beta: not heard for more than 1 s");
  daemon_.Pass(30);
  EXPECT_EQ(waiting_for(), "beta") << "one that the world waits for is not removed";
  EXPECT_EQ(now_ns(), 0);
  daemon_.Step({Command(1, v1::OPERATOR_EVICT, "beta")}, 0.01);
  EXPECT_EQ(waiting_for(), "");
  EXPECT_GT(now_ns(), 0);
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

TEST_F(StartedAgainTest, WhoHadTakenItsLastStepIsNotWaitedFor) {
  v1::SimulatorClock last = ClockAfter("beta", granted_ns("alpha"), 0, 1);
  last.set_run(2);
  last.set_next_ns(kNeverNs);
  daemon_.Step({From(12, last)}, 0.01);
  daemon_.Step({Liveliness(12, "beta", false)}, 0.01);
  daemon_.Step({From(22, Description("beta", 0, 3))}, 0.01);
  AlphaReaches(granted_ns("alpha"));
  EXPECT_GT(now_ns(), 0);
}

}  // namespace
}  // namespace collision::server
