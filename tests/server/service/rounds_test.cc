// Goal:   in lock-step the events follow from the simulators alone, and time goes on only when
//         everybody has told everything.
// Method: two simulators with different steps whose agents pass through each other, at a daemon
//         that gets their messages in any order and in batches of any size, late, doubled and
//         without those that newer ones have replaced.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kEnd = 1000 * kMillisecond;

v1::Config ConfigFor(std::uint32_t simulators) {
  v1::Config config = Simulated();
  config.set_temporal_resolution_s(0.02);
  config.mutable_clock()->set_simulators_awaited(simulators);
  config.mutable_clock()->set_grant_ahead_max_s(0.3);
  return config;
}

/// A simulator of one agent that moves along x and turns back where it is told of a contact.
class Mover {
 public:
  Mover(std::string name, std::uint64_t sender, double side, std::int64_t step_ns)
      : name_(std::move(name)), sender_(sender), side_(side), step_ns_(step_ns) {}

  std::vector<v1::Input> Begin() {
    v1::AgentDescription description = Description(name_, 0);
    return {From(sender_, description), Tell()};
  }

  /// What it writes when it is granted this time: at most one step, and nothing if that is not
  /// granted.
  std::vector<v1::Input> Advance(std::int64_t granted_ns) {
    if (finished_ || granted_ns < next_ns_) return {};
    clock_ns_ = next_ns_;
    next_ns_ = clock_ns_ + step_ns_;
    finished_ = clock_ns_ >= kEnd;
    return {Tell()};
  }

  bool finished() const { return finished_; }
  std::uint64_t id() const { return SimulatorId(name_); }

  /// The newest of its messages is all that counts of each kind.
  v1::Input NewestState() const {
    v1::AgentState state = State(0, clock_ns_, sequence_);
    const double seconds = 1e-9 * static_cast<double>(clock_ns_);
    state.mutable_position_m()->set_x(side_ * (-5 + 10 * seconds));
    state.mutable_velocity_m_s()->set_x(side_ * 10);
    return From(sender_, state, name_);
  }

  v1::Input NewestClock() const {
    v1::SimulatorClock clock = ClockAfter(name_, clock_ns_, sequence_, 1);
    clock.set_next_ns(finished_ ? kNeverNs : next_ns_);
    return From(sender_, clock);
  }

 private:
  /// A step is a state and, when the network gets to it, the clock behind it.
  v1::Input Tell() {
    ++sequence_;
    return NewestState();
  }

  std::string name_;
  std::uint64_t sender_;
  double side_;
  std::int64_t step_ns_;
  std::int64_t clock_ns_ = 0;
  std::int64_t next_ns_ = step_ns_;
  std::uint64_t sequence_ = 0;
  bool finished_ = false;
};

/// The daemon's log of one run over a network with this seed; 0: nothing is reordered or lost.
std::string EventsOf(std::uint64_t seed) {
  Random random(seed);
  ScriptedDaemon daemon(ConfigFor(2));
  std::vector<Mover> movers = {{"alpha", 1, 1, 50 * kMillisecond},
                               {"beta", 2, -1, 35 * kMillisecond}};
  std::vector<v1::Input> waiting;
  for (Mover& mover : movers) {
    for (const v1::Input& input : mover.Begin()) waiting.push_back(input);
    waiting.push_back(mover.NewestClock());
  }
  const auto granted = [&](const Mover& mover) {
    std::int64_t newest = -1;
    for (const v1::Output& output : daemon.bus().outputs) {
      if (!output.has_clearance() || output.clearance().simulator_id() != mover.id()) continue;
      newest = std::max(newest, output.clearance().granted_until_ns());
    }
    return newest;
  };
  for (int step = 0; step < 20000; ++step) {
    // A few of the messages that are on their way arrive.
    std::vector<v1::Input> batch;
    while (!waiting.empty() && (seed == 0 || random.Chance(0.6))) {
      const std::size_t next = seed == 0 ? 0 : random.Below(waiting.size());
      batch.push_back(waiting[next]);
      if (seed == 0 || !random.Chance(0.1)) waiting.erase(waiting.begin() + std::ptrdiff_t(next));
    }
    daemon.Step(batch, 0.001);
    bool finished = true;
    for (Mover& mover : movers) {
      const std::vector<v1::Input> told = mover.Advance(granted(mover));
      waiting.insert(waiting.end(), told.begin(), told.end());
      if (!told.empty()) waiting.push_back(mover.NewestClock());
      if (!told.empty() && seed != 0 && random.Chance(0.5)) {
        // Overwritten before it was sent: only the newest of each kind arrives.
        std::erase_if(waiting, [&](const v1::Input& input) {
          return input.agent_states().simulator_id() == mover.id() ||
                 input.simulator_clock().simulator_id() == mover.id();
        });
        waiting.push_back(mover.NewestClock());
        waiting.push_back(mover.NewestState());
      }
      finished &= mover.finished();
    }
    if (finished && waiting.empty()) break;
  }
  for (int i = 0; i < 10; ++i) daemon.Step({}, 0.001);
  std::string log;
  for (const v1::Output& output : daemon.bus().outputs) {
    if (!output.has_collision_event() || output.collision_event().contacts_sequence() == 0)
      continue;
    log += v1::EventStatus_Name(output.collision_event().status()) + " at " +
           std::to_string(output.collision_event().now_ns()) + "\n";
  }
  return log + std::to_string(daemon.daemon().event_log().count()) + " " +
         std::to_string(daemon.daemon().event_log().hash());
}

TEST(Rounds, TheEventsDoNotDependOnTheNetwork) {
  const std::string straight = EventsOf(0);
  EXPECT_NE(straight.find("EVENT_CONFIRMED"), std::string::npos) << straight;
  EXPECT_NE(straight.find("EVENT_ENDED"), std::string::npos) << straight;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) EXPECT_EQ(EventsOf(seed), straight) << seed;
}

// Goal:   time waits for whoever has not said that it has nothing more to tell; who has no further
//         step is not waited for.
TEST(Rounds, TimeWaitsForEverybodyThatHasAStep) {
  ScriptedDaemon daemon(ConfigFor(2));
  Mover alpha("alpha", 1, 1, 50 * kMillisecond);
  Mover beta("beta", 2, -1, 50 * kMillisecond);
  for (Mover* mover : {&alpha, &beta}) {
    std::vector<v1::Input> inputs = mover->Begin();
    inputs.push_back(mover->NewestClock());
    daemon.Step(inputs);
  }
  const std::int64_t granted = daemon.clearance(alpha.id()).granted_until_ns();
  EXPECT_GE(granted, 50 * kMillisecond);
  EXPECT_EQ(daemon.clearance(beta.id()).granted_until_ns(), granted) << "one grant for all";
  for (std::int64_t last = -1; last != granted;) {
    std::vector<v1::Input> told = alpha.Advance(granted);
    if (told.empty()) break;
    told.push_back(alpha.NewestClock());
    daemon.Step(told);
  }
  EXPECT_EQ(daemon.status().now_ns(), 0) << "beta has told nothing yet";
  v1::Input finished = beta.NewestClock();
  finished.mutable_simulator_clock()->set_next_ns(kNeverNs);
  daemon.Step({finished});
  EXPECT_GE(daemon.status().now_ns(), granted);
  EXPECT_GT(daemon.clearance(alpha.id()).granted_until_ns(), granted);
}

// Goal:   who has no further step may still remove its agents.
TEST(Rounds, AfterTheLastOneAgentsCanStillLeave) {
  ScriptedDaemon daemon(ConfigFor(1));
  Mover alpha("alpha", 1, 1, 50 * kMillisecond);
  daemon.Step(alpha.Begin());
  v1::Input finished = alpha.NewestClock();
  finished.mutable_simulator_clock()->set_next_ns(kNeverNs);
  daemon.Step({finished});
  ASSERT_EQ(daemon.status().simulators(0).agents(), 1u);
  daemon.Step({Removal(1, "alpha", 0), finished});
  EXPECT_EQ(daemon.status().simulators(0).agents(), 0u);
}

TEST(Rounds, NobodyWaitsForOneThatHasFinishedAndFallsSilent) {
  for (const bool has_finished : {false, true}) {
    ScriptedDaemon daemon(ConfigFor(1));
    Mover alpha("alpha", 1, 1, 50 * kMillisecond);
    daemon.Step(alpha.Begin());
    v1::Input clock = alpha.NewestClock();
    if (has_finished) clock.mutable_simulator_clock()->set_next_ns(kNeverNs);
    daemon.Step({clock});
    daemon.Step({Liveliness(1, "alpha", false)});
    daemon.Pass(5);
    EXPECT_EQ(Extension(daemon.status(), "waiting_for"), has_finished ? "" : "alpha");
  }
}

// Goal:   a simulator that does not say when its next step is gets along, as before there were
//         rounds: time follows its clock.
TEST(Rounds, WithoutNextStepsTimeFollowsTheClocks) {
  ScriptedDaemon daemon(ConfigFor(1));
  daemon.Step(AlphaJoins(1));
  daemon.Step({From(1, ClockAfter("alpha", 7 * kMillisecond, 2, 2))});
  EXPECT_EQ(daemon.status().now_ns(), 7 * kMillisecond);
}

// Goal:   what an agent does counts also where all of its simulator but the clock arrives at once.
// Method: a newcomer whose agent stands in another one and leaves in good order; its clock arrives
//         after that, or never, in each order in which the rest may.
TEST(Rounds, WhoIsGoneBeforeItsClockArrivesHasBeenThere) {
  const auto contacts_with = [](const std::vector<v1::Input>& after_the_states) {
    ScriptedDaemon daemon(ConfigFor(1));
    Mover alpha("alpha", 1, 1, 50 * kMillisecond);
    daemon.Step(alpha.Begin());
    daemon.Step({alpha.NewestClock()});
    daemon.Step({From(2, Description("beta", 0))});
    v1::AgentState there = State(0, 0, 1);
    there.mutable_position_m()->set_x(-5);
    daemon.Step({From(2, there, "beta")});
    for (const v1::Input& input : after_the_states) daemon.Step({input});
    for (int step = 0; step < 40; ++step) {
      std::vector<v1::Input> told = alpha.Advance(daemon.clearance(alpha.id()).granted_until_ns());
      if (!told.empty()) told.push_back(alpha.NewestClock());
      daemon.Step(told);
    }
    EXPECT_TRUE(alpha.finished()) << "nobody waits for the other one";
    EXPECT_EQ(daemon.status().agents(), 1u);
    const std::vector<v1::Output>& outputs = daemon.bus().outputs;
    return std::ranges::count_if(outputs, [](const v1::Output& output) {
      return output.collision_event().contacts_sequence() > 0;
    });
  };
  v1::SimulatorClock clock = ClockAfter("beta", 100 * kMillisecond, 1, 1);
  clock.set_next_ns(kNeverNs);
  const v1::Input removal = Removal(2, "beta", 0);
  const v1::Input dead = Liveliness(2, "beta", false);
  EXPECT_GT(contacts_with({removal, From(2, clock), dead}), 0);
  EXPECT_GT(contacts_with({removal, dead}), 0);
  EXPECT_GT(contacts_with({dead, removal}), 0);
}

}  // namespace
}  // namespace collision::server
