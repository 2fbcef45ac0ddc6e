// What may go wrong beside the network: each case its own small world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/simulation/contact_checker.h"
#include "tests/simulation/scenario.h"

namespace collision::server {
namespace {

constexpr std::int64_t kEnd = 10 * kSecond;

/// At rest at x, free to accelerate by 1 m/s².
SimulatedAgent At(double x, double v = 0) {
  return {.radius = 1, .acceleration_max = 1, .motion = Straight({x, 0, 0}, {v, 0, 0}, kEnd)};
}

/// The last event of the only pair in contact; it must exist.
v1::CollisionEvent LastEvent(const Scenario& scenario) {
  const auto events = scenario.events();
  if (events.empty()) throw std::logic_error("no event was published");
  return events.back();
}

/// Whether any clearance of `agent` named this cause.
bool Named(const Scenario& scenario, const detection::AgentId& agent, v1::ClearanceCause cause) {
  for (const v1::Output& output : scenario.published()) {
    if (!output.has_clearance() || output.clearance().simulator_id() != agent.simulator) continue;
    for (const v1::AgentClearance& clearance : output.clearance().agents()) {
      if (clearance.slot() == agent.slot && clearance.cause() == cause) return true;
    }
  }
  return false;
}

// Goal:   a state that breaks its own bound is the new truth, is counted, and its partners are
// informed. Method: a resting agent appears moved by 80 m without a discontinuity, so near that the
// partner's clearance must be lowered.
TEST(Faults, ABreachIsTheNewTruthAndIsReported) {
  Scenario scenario(ConfigFor(1), {});
  SimulatedAgent mover = At(100);
  mover.motion.pieces = {{.start_ns = 0, .end_ns = 3 * kSecond, .p = {100, 0, 0}},
                         {.start_ns = 3 * kSecond, .end_ns = kEnd, .p = {20, 0, 0}}};
  auto& alpha = scenario.Add({.end_ns = kEnd}, {At(0), mover});
  scenario.StartService();
  alpha.Start();
  scenario.Run();
  EXPECT_EQ(scenario.counter("breaches"), 1u);
  EXPECT_TRUE(Named(scenario, alpha.AgentAt(0), v1::CAUSE_BREACH));
  EXPECT_TRUE(alpha.rejections().empty());
  EXPECT_TRUE(alpha.finished());
}

// Goal:   a declared jump is no breach, its partners are informed, and the contact it leads to is
// found. Method: the agent jumps from 1 km to 20 m and closes in at 10 m/s: contact 1.8 s after the
// jump.
TEST(Faults, ATeleportIsNoBreach) {
  Scenario scenario(ConfigFor(2), {});
  SimulatedAgent mover = At(0);
  mover.motion.pieces = {
      {.start_ns = 0, .end_ns = 3 * kSecond, .p = {1000, 0, 0}},
      {.start_ns = 3 * kSecond, .end_ns = kEnd, .p = {52, 0, 0}, .v = {-10, 0, 0}}};
  mover.motion.jumps_ns = {3 * kSecond};
  auto& alpha = scenario.Add({.name = "alpha", .sender = 1, .end_ns = kEnd}, {At(0)});
  auto& beta = scenario.Add({.name = "beta", .sender = 2, .end_ns = kEnd}, {mover});
  scenario.StartService();
  alpha.Start();
  beta.Start();
  scenario.Run();
  EXPECT_EQ(scenario.counter("breaches"), 0u);
  EXPECT_EQ(scenario.counter("discontinuities"), 1u);
  EXPECT_TRUE(Named(scenario, alpha.AgentAt(0), v1::CAUSE_TELEPORT));
  const CheckerResult result = CheckContacts(scenario.simulators(), scenario.published(), kEnd);
  EXPECT_TRUE(result.violations.empty()) << ViolationsOf(result);
  EXPECT_EQ(result.contacts, 1u);
  EXPECT_EQ(result.confirmed, 1u);
}

// Goal:   an agent admitted in the middle of the run, on a collision course, is announced before
//         it touches, and nothing that was granted before is withdrawn.
TEST(Faults, ALateAdmissionTakesEffectAtTheGreatestGrant) {
  Scenario scenario(ConfigFor(2), {});
  SimulatedAgent late = At(0);
  late.motion = Straight({100, 0, 0}, {-10, 0, 0}, kEnd);  // 12 m away at 8.8 s... touches at 9.8 s
  late.from_ns = 4 * kSecond;
  auto& alpha = scenario.Add({.name = "alpha", .sender = 1, .end_ns = kEnd}, {At(0)});
  auto& beta = scenario.Add({.name = "beta", .sender = 2, .end_ns = kEnd}, {late});
  scenario.StartService();
  alpha.Start();
  beta.Start();
  scenario.Run();
  EXPECT_FALSE(alpha.grant_withdrawn());
  EXPECT_TRUE(Named(scenario, alpha.AgentAt(0), v1::CAUSE_ADMISSION));
  const CheckerResult result = CheckContacts(scenario.simulators(), scenario.published(), kEnd);
  EXPECT_TRUE(result.violations.empty()) << ViolationsOf(result);
  EXPECT_EQ(result.contacts, 1u);
}

// Goal:   removing an agent withdraws its open events and ends its confirmed ones.
// Method: one is removed half a second before it would touch, the other in the midst of a contact.
TEST(Faults, ARemovalClosesItsEvents) {
  for (const bool touching : {false, true}) {
    Scenario scenario(ConfigFor(1), {});
    SimulatedAgent mover = At(0);
    mover.motion = Straight({12, 0, 0}, {-2, 0, 0}, kEnd);  // touches in [5, 7] s
    mover.until_ns = touching ? 6 * kSecond : kSecond * 9 / 2;
    auto& alpha = scenario.Add({.end_ns = kEnd}, {At(0), mover});
    scenario.StartService();
    alpha.Start();
    scenario.Run();
    EXPECT_EQ(LastEvent(scenario).status(), touching ? v1::EVENT_ENDED : v1::EVENT_WITHDRAWN);
    EXPECT_TRUE(alpha.finished());
  }
}

// Goal:   a silent simulator holds the world up for ever, or for release_after_s; its agents stay.
// Method: beta is killed at 3 s; alpha's agent runs into beta's resting one at 7 s.
TEST(Faults, ASilentSimulatorIsWaitedForOrReleased) {
  for (const auto policy : {v1::Clock::WAIT, v1::Clock::RELEASE}) {
    v1::Config config = ConfigFor(2);
    config.mutable_clock()->set_on_silent_simulator(policy);
    Scenario scenario(config, {});
    SimulatedAgent mover = At(0);
    mover.motion = Straight({-16, 0, 0}, {2, 0, 0}, kEnd);
    SimulatedAgent still = At(0);
    still.acceleration_max = 0;
    auto& alpha = scenario.Add({.name = "alpha", .sender = 1, .end_ns = kEnd}, {mover});
    auto& beta = scenario.Add(
        {.name = "beta", .sender = 2, .end_ns = 3 * kSecond, .removes_at_end = false}, {still});
    scenario.StartService();
    alpha.Start();
    beta.Start();
    // It comes to its end without leaving, and its program dies.
    scenario.network().At(20 * kSecond, [&beta] { beta.Kill(); });
    scenario.network().At(60 * kSecond, [] {});
    scenario.Run();
    EXPECT_EQ(alpha.finished(), policy == v1::Clock::RELEASE) << alpha.clock_ns();
    if (policy == v1::Clock::WAIT) {
      EXPECT_EQ(scenario.status().now_ns(), 3 * kSecond);
      continue;
    }
    const auto events = scenario.events();
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const v1::CollisionEvent& event) {
      return event.status() == v1::EVENT_POSSIBLE && event.now_ns() <= 7 * kSecond &&
             event.begin().earliest_ns() <= 7 * kSecond;
    }));
    // Nobody holds time any more: what beta has left behind is gone with the epoch.
    EXPECT_EQ(scenario.status().agents(), 0u);
  }
}

// Goal:   a simulator that comes back with a higher run starts anew: its old agents are gone, and
//         the world goes on to the end without losing or doubling anything.
TEST(Faults, AHigherRunStartsAnew) {
  Scenario scenario(ConfigFor(2), {});
  auto& alpha = scenario.Add({.name = "alpha", .sender = 1, .end_ns = kEnd}, {At(0)});
  auto& first = scenario.Add({.name = "beta", .sender = 2, .end_ns = kEnd}, {At(50), At(60)});
  auto& second = scenario.Add(
      {.name = "beta", .run = 2, .sender = 3, .start_ns = 2 * kSecond, .end_ns = kEnd}, {At(55)});
  scenario.StartService();
  alpha.Start();
  first.Start();
  // The successor comes before the lease is over.
  scenario.network().At(10'000'000, [&first] { first.Kill(); });
  second.Start(500'000'000);
  scenario.Run();
  EXPECT_TRUE(alpha.finished());
  EXPECT_TRUE(second.finished());
  EXPECT_EQ(scenario.counter("agents_admitted"), 4u);
  EXPECT_EQ(scenario.counter("agents_removed"), 4u);
}

// Goal:   a service that starts anew recovers everything from the histories of the living writers.
// Method: the service is replaced in the middle of the run; the contact afterwards is announced and
// bracketed.
TEST(Faults, ANewServiceRecoversFromTheNetworkAlone) {
  Scenario scenario(ConfigFor(2), {});
  SimulatedAgent mover = At(0);
  mover.motion = Straight({18, 0, 0}, {-2, 0, 0}, kEnd);  // touches in [8, 10] s
  auto& alpha = scenario.Add({.name = "alpha", .sender = 1, .end_ns = kEnd}, {At(0)});
  auto& beta = scenario.Add({.name = "beta", .sender = 2, .end_ns = kEnd}, {mover});
  scenario.StartService();
  alpha.Start();
  beta.Start();
  while (scenario.simulators()[0]->clock_ns() < 2 * kSecond) ASSERT_TRUE(scenario.daemon().Step());
  scenario.StartService();
  scenario.Run();
  EXPECT_TRUE(alpha.finished());
  EXPECT_TRUE(beta.finished());
  EXPECT_TRUE(alpha.rejections().empty());
  EXPECT_EQ(scenario.counter("breaches"), 0u);
  const CheckerResult result = CheckContacts(scenario.simulators(), scenario.published(), kEnd);
  EXPECT_TRUE(result.violations.empty()) << ViolationsOf(result);
  EXPECT_EQ(result.contacts, 1u);
  EXPECT_EQ(result.confirmed, 1u);
}

}  // namespace
}  // namespace collision::server
