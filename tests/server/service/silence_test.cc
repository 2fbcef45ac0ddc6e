// Goal:   a simulator that does not move is named, and released by policy, whether its process
//         lives or not; the silent are removed after the configured time, told as such, and make
//         room; nothing of it happens a moment too early, nor to one that moves.
// Method: a daemon whose every step and clock reading the test writes.
#include <gtest/gtest.h>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kTenth = 100'000'000;  ///< [ns]

/// Two simulators of one agent each, which meet: they touch from 1.5 s on, unless they change.
class SilenceTest : public testing::Test {
 protected:
  explicit SilenceTest(v1::Clock::OnSilent on_silent = v1::Clock::WAIT)
      : daemon_(OfTwoSimulators(on_silent)) {
    daemon_.Step(Told("alpha", 0), 0.01);
    daemon_.Step(Told("beta", 0), 0.01);
  }

  static std::uint64_t SenderOf(const std::string& name) { return name == "alpha" ? 1 : 2; }

  static std::vector<v1::Input> Told(const std::string& name, std::int64_t clock_ns,
                                     std::uint32_t run = 1) {
    const std::uint64_t sender = SenderOf(name) + 10 * (run - 1);
    const double side = name == "alpha" ? -1 : 1;
    const auto sequence = static_cast<std::uint64_t>(clock_ns / kTenth) + 1;
    v1::AgentState state = State(0, clock_ns, sequence);
    state.mutable_position_m()->set_x(side * (2.5 - 1e-9 * static_cast<double>(clock_ns)));
    state.mutable_velocity_m_s()->set_x(-side);
    v1::SimulatorClock clock = ClockAfter(name, clock_ns, sequence, 1);
    clock.set_run(run);
    std::vector<v1::Input> inputs;
    if (clock_ns == 0) inputs.push_back(From(sender, Description(name, 0, run)));
    inputs.push_back(From(sender, state, name, run));
    inputs.push_back(From(sender, clock));
    return inputs;
  }

  std::string waiting_for() { return Extension(daemon_.status(), "waiting_for"); }

  std::int64_t now_ns() { return daemon_.status().now_ns(); }

  v1::CollisionEvent last_event() const {
    for (auto output = daemon_.bus().outputs.rbegin(); output != daemon_.bus().outputs.rend();
         ++output) {
      if (output->has_collision_event()) return output->collision_event();
    }
    throw std::logic_error("no event was published");
  }

  static std::string Because(const v1::CollisionEvent& event) {
    for (const v1::KeyValue& extension : event.extensions()) {
      if (extension.key() == "because") return extension.value();
    }
    return "";
  }

  mutable ScriptedDaemon daemon_;
};

class SilenceReleaseTest : public SilenceTest {
 protected:
  SilenceReleaseTest() : SilenceTest(v1::Clock::RELEASE) {}
};

TEST_F(SilenceTest, ALiveSimulatorThatStandsIsNamedAndWaitedFor) {
  daemon_.Step(Told("alpha", kTenth), 0.01);
  daemon_.Step({}, 1.5);
  EXPECT_EQ(waiting_for(), "") << "2.5 s";
  // The bus is asked to wake the daemon when a name is due.
  daemon_.Step({}, 0.4);
  EXPECT_LE(daemon_.bus().timeout_ns, 500'000'000);
  daemon_.Step({}, 0.2);
  EXPECT_EQ(waiting_for(), "beta");
  daemon_.Step({}, 3600);
  EXPECT_EQ(waiting_for(), "beta");
  EXPECT_EQ(now_ns(), 0);
  daemon_.Step(Told("beta", kTenth), 0.01);
  EXPECT_EQ(waiting_for(), "");
  EXPECT_EQ(now_ns(), kTenth);
}

TEST_F(SilenceTest, TheStatusTellsWhyTheWorldWaitsAndWhoIsEvicted) {
  const auto told = [&](const char* key) { return Extension(daemon_.status(), key); };
  daemon_.Step(Told("alpha", kTenth), 0.01);
  EXPECT_EQ(told("waiting_why"), "");
  daemon_.Step({}, 3.5);
  EXPECT_EQ(told("waiting_why"), "beta: was granted time and has not made its next step");
  daemon_.Step({Liveliness(2, "beta", false)}, 0.01);
  daemon_.Step({}, 7.5);
  EXPECT_EQ(told("waiting_why"), "beta: not heard for more than 8 s");
  EXPECT_EQ(told("evicted"), "");
  v1::Input evict;
  evict.mutable_operator_command()->set_command_id(1);
  evict.mutable_operator_command()->set_kind(v1::OPERATOR_EVICT);
  evict.mutable_operator_command()->set_simulator("beta");
  daemon_.Step({evict}, 0.01);
  daemon_.Step({}, 1.5);
  EXPECT_EQ(told("waiting_why"), "");
  EXPECT_EQ(told("evicted"), "beta");
  daemon_.Step(Told("beta", kTenth, 2), 1.5);
  EXPECT_EQ(told("evicted"), "") << "it is back";
}

TEST_F(SilenceTest, WhoTellsAnythingIsNotNamedAndARepeatedClockTellsNothing) {
  daemon_.Step(Told("alpha", kTenth), 0.01);
  for (int i = 0; i < 10; ++i) {
    v1::AgentDescription description = Description("beta", 1);
    description.set_revision(static_cast<std::uint32_t>(i + 1));
    daemon_.Step({From(2, description)}, 2);
    EXPECT_EQ(waiting_for(), "");
  }
  for (int i = 0; i < 4; ++i) daemon_.Step({From(2, ClockAfter("beta", 0, 1, 1))}, 1);
  EXPECT_EQ(waiting_for(), "beta");
}

TEST_F(SilenceReleaseTest, ALiveSimulatorThatStandsIsReleasedAndComesBackWithItsNextClock) {
  daemon_.Step(Told("alpha", kTenth), 0.01);
  daemon_.Step({}, 7.9);
  EXPECT_EQ(daemon_.clearance(SimulatorId("alpha")).now_ns(), 0);
  daemon_.Step({}, 0.2);
  EXPECT_EQ(now_ns(), kTenth);
  EXPECT_EQ(waiting_for(), "");
  daemon_.Step({From(2, ClockAfter("beta", 0, 1, 1))}, 0.01);
  daemon_.Step(Told("alpha", 2 * kTenth), 0.01);
  EXPECT_EQ(now_ns(), 2 * kTenth) << "a clock that is repeated is not its next one";
  daemon_.Step(Told("beta", kTenth), 0.01);
  daemon_.Step(Told("alpha", 3 * kTenth), 0.01);
  EXPECT_EQ(now_ns(), 2 * kTenth) << "it holds time again";
  EXPECT_EQ(daemon_.status().stamp().epoch(), 1u);
}

TEST_F(SilenceReleaseTest, WhereNobodyWaitsNobodyIsReleased) {
  // Both stand at the same clock: a pause of all, not of one that holds up the others.
  daemon_.Step({}, 0.01);
  daemon_.Step({}, 3600);
  EXPECT_EQ(waiting_for(), "alpha, beta");
  EXPECT_EQ(daemon_.status().stamp().epoch(), 1u);
  EXPECT_EQ(daemon_.status().agents(), 2u);
}

// Goal:   a standstill of the service is nobody's silence.
TEST_F(SilenceReleaseTest, AServiceThatStoodStillReleasesNobodyBeforeItHasListened) {
  daemon_.Step(Told("alpha", kTenth), 0.01);
  daemon_.Step({}, 3600);
  daemon_.Step({}, 0.001);
  EXPECT_GT(daemon_.bus().timeout_ns, 0) << "it does not spin";
  daemon_.Step(Told("beta", kTenth), 0.9);
  daemon_.Step(Told("alpha", 2 * kTenth), 0.01);
  EXPECT_EQ(now_ns(), kTenth) << "beta holds time all along";
}

TEST_F(SilenceReleaseTest, TheReleasedAreRemovedAfterTheConfiguredTimeAndTold) {
  daemon_.Step(Told("alpha", kTenth), 0.01);
  daemon_.Pass(8.1);
  daemon_.Pass(18);
  EXPECT_EQ(daemon_.status().agents(), 2u);
  daemon_.Step({}, 1.5);
  const v1::ServiceStatus status = daemon_.status();
  EXPECT_EQ(status.agents(), 1u);
  ASSERT_EQ(status.simulators_size(), 1);
  EXPECT_EQ(status.simulators(0).name(), "alpha");
  EXPECT_EQ(Extension(status, "removed_silent"), "beta");
  EXPECT_EQ(daemon_.counter("simulators_removed_silent"), 1u);
  EXPECT_EQ(last_event().status(), v1::EVENT_WITHDRAWN);
  EXPECT_EQ(Because(last_event()), "silent");
  // What goes on under that run is refused, in words; a higher run is welcome.
  EXPECT_TRUE(daemon_.rejections().empty());
  daemon_.Step(Told("beta", kTenth), 0.01);
  ASSERT_EQ(daemon_.rejections().size(), 2u);
  EXPECT_EQ(daemon_.rejections()[0].reason(), v1::REJECTED_OLD_RUN);
  EXPECT_EQ(daemon_.rejections()[0].detail(),
            "run 1; run 1 was removed as silent; allowed: a higher run, which is welcome");
  daemon_.Step(Told("beta", 0, 2), 0.01);
  EXPECT_EQ(daemon_.rejections().size(), 2u);
  EXPECT_EQ(daemon_.status().agents(), 2u);
}

TEST_F(SilenceTest, WhileTheWorldWaitsNobodyIsRemoved) {
  daemon_.Step(Told("alpha", kTenth), 0.01);
  daemon_.Step({Liveliness(2, "beta", false)}, 0.01);
  daemon_.Step({}, 86'400);
  EXPECT_EQ(daemon_.status().agents(), 2u);
  EXPECT_EQ(waiting_for(), "beta");
}

TEST_F(SilenceTest, WhoDiedBeforeItsFirstClockMakesRoom) {
  daemon_.Step({From(3, Description("gamma", 0)), Liveliness(3, "gamma", false)}, 0.01);
  EXPECT_EQ(daemon_.status().simulators_size(), 3);
  daemon_.Step({}, 20);
  EXPECT_EQ(daemon_.status().simulators_size(), 2);
}

v1::Config Wall(double remove_silent_after_s) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_remove_silent_after_s(remove_silent_after_s);
  config.set_simulators_max(2);
  config.set_agents_max(2);
  return config;
}

/// A simulator with an agent, of which the last word is from the daemon's start.
std::vector<v1::Input> Joins(ScriptedDaemon* daemon, const std::string& name,
                             std::uint64_t sender) {
  return {From(sender, Description(name, 0)),
          From(sender, State(0, daemon->bus().wall_ns, 1), name)};
}

TEST(SilenceOnTheWallClock, TheDeadAreRemovedAfterTheConfiguredTimeAndTheirPlacesAreFree) {
  ScriptedDaemon daemon(Wall(30));
  daemon.Step(Joins(&daemon, "alpha", 1), 1);
  daemon.Step(Joins(&daemon, "beta", 2), 0.001);
  daemon.Step({Liveliness(2, "beta", false)}, 1);
  daemon.Pass(29.9);
  daemon.Step(Joins(&daemon, "gamma", 3), 0.01);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_TOO_MANY_SIMULATORS);
  daemon.Step({}, 0.1);
  daemon.Step(Joins(&daemon, "gamma", 3), 0.01);
  EXPECT_EQ(daemon.rejections().size(), 1u);
  const v1::ServiceStatus status = daemon.status();
  EXPECT_EQ(status.agents(), 2u);
  ASSERT_EQ(status.simulators_size(), 2);
  // Beta's place went to gamma, but it is not forgotten.
  daemon.Step(Joins(&daemon, "beta", 2), 0.01);
  EXPECT_EQ(daemon.rejections().back().reason(), v1::REJECTED_OLD_RUN);
}

TEST(SilenceOnTheWallClock, AServiceThatStoodStillRemovesNobodyBeforeItHasListened) {
  ScriptedDaemon daemon(Wall(30));
  daemon.Step(Joins(&daemon, "alpha", 1), 1);
  daemon.Step(Joins(&daemon, "beta", 2), 0.001);
  daemon.Step({Liveliness(2, "beta", false)}, 1);
  daemon.Step({}, 40);
  daemon.Step(Joins(&daemon, "gamma", 3), 0.01);
  EXPECT_EQ(daemon.rejections().size(), 1u) << "beta has its place still";
  daemon.Step({}, 1);
  daemon.Step(Joins(&daemon, "gamma", 3), 0.01);
  EXPECT_EQ(daemon.rejections().size(), 1u);
}

TEST(SilenceOnTheWallClock, TheLivingStayAndSoDoTheDeadWithoutALimit) {
  ScriptedDaemon daemon(Wall(0));
  daemon.Step(Joins(&daemon, "alpha", 1), 1);
  daemon.Step({Liveliness(1, "alpha", false)}, 1);
  daemon.Step({}, 1e6);
  EXPECT_EQ(daemon.status().agents(), 1u);
  ScriptedDaemon other(Wall(30));
  other.Step(Joins(&other, "alpha", 1), 1);
  other.Step({}, 1e6);
  EXPECT_EQ(other.status().agents(), 1u);
}

// Two that are 5 km apart, with 20 m/s² each. The dead one's bound reaches the other after 16 s.
TEST(SilenceOnTheWallClock, TheNeighbourOfTheRemovedIsClearAgain) {
  ScriptedDaemon daemon(Wall(60));
  std::uint64_t sequence = 0;
  const auto tell = [&](const std::string& name, std::uint64_t sender, double x) {
    v1::AgentState state = State(0, daemon.bus().wall_ns + daemon.bus().monotonic_ns, ++sequence);
    state.mutable_position_m()->set_x(x);
    return From(sender, state, name);
  };
  const auto describe = [](const std::string& name, std::uint64_t sender) {
    v1::AgentDescription description = Description(name, 0);
    description.set_acceleration_max_m_s2(20);
    return From(sender, description);
  };
  daemon.Step({describe("alpha", 1), tell("alpha", 1, 0)});
  daemon.Step({describe("beta", 2), tell("beta", 2, 5000)});
  daemon.Step({Liveliness(2, "beta", false)});
  for (int second = 1; second <= 62; ++second) {
    daemon.Step({}, 1);
    daemon.Step({tell("alpha", 1, 0)});
    const v1::Clearance clearance = daemon.clearance(SimulatorId("alpha"));
    ASSERT_EQ(clearance.agents_size(), 1);
    if (second > 23 && second < 60) {
      EXPECT_TRUE(clearance.agents(0).not_clear()) << second;
    }
    if (second > 60) {
      EXPECT_FALSE(clearance.agents(0).not_clear()) << second;
      EXPECT_EQ(clearance.agents(0).clear_until_ns(), kNeverNs);
    }
  }
}

TEST(SilenceOnTheWallClock, WhoIsBackInTimeBeginsAnew) {
  ScriptedDaemon daemon(Wall(30));
  daemon.Step(Joins(&daemon, "alpha", 1), 1);
  for (int i = 0; i < 5; ++i) {
    daemon.Step({Liveliness(1, "alpha", false)}, 1);
    daemon.Step({}, 25);
    daemon.Step({Liveliness(1, "alpha", true)}, 1);
  }
  EXPECT_EQ(daemon.status().agents(), 1u);
}

TEST(SilenceOnTheWallClock, WhoStartsAgainAndDiesWithoutAgentsMakesRoom) {
  ScriptedDaemon daemon(Wall(0));
  const auto clock = [](std::uint64_t sender, std::uint32_t run, std::int64_t clock_ns) {
    v1::SimulatorClock told = ClockOf("alpha", clock_ns, run);
    told.set_lock_step(false);
    return From(sender, told);
  };
  daemon.Step(Joins(&daemon, "alpha", 1), 0.01);
  daemon.Step({clock(1, 1, daemon.bus().wall_ns)}, 0.01);
  daemon.Step({Liveliness(1, "alpha", false)}, 0.01);
  daemon.Step({clock(2, 2, Instant::Always().nanoseconds())}, 0.01);  // It is there.
  EXPECT_EQ(daemon.status().simulators_size(), 1);
  daemon.Step({Liveliness(2, "alpha", false)}, 0.01);
  EXPECT_EQ(daemon.status().simulators_size(), 0);
}

}  // namespace
}  // namespace collision::server
