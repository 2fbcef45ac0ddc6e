#include "server/world.h"

#include <gtest/gtest.h>

#include "server/config.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

v1::Config Simulated(std::uint32_t awaited, v1::Clock::OnSilent on_silent = v1::Clock::WAIT) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::SIMULATED);
  config.mutable_clock()->set_simulators_awaited(awaited);
  config.mutable_clock()->set_on_silent_simulator(on_silent);
  config.mutable_clock()->set_release_after_s(5);
  config.set_simulators_max(3);
  return CompleteConfig(config);
}

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

Simulator& Join(World* world, std::uint64_t id, std::uint64_t sender, std::int64_t clock_ns) {
  const std::string name = "simulator " + std::to_string(id);
  Simulator& simulator = *world->ClaimFor(id, sender, 1, &name).simulator;
  simulator.OfferClock({.clock = At(clock_ns)});
  EXPECT_TRUE(world->TakeClock(&simulator));
  return simulator;
}

// Goal:   an id belongs to whoever named itself first, until it is gone and a higher run comes.
TEST(World, AnIdHasOneOwner) {
  World world(Simulated(1));
  const std::string name = "a";
  EXPECT_TRUE(world.ClaimFor(1, 10, 5, &name).accepted);
  EXPECT_TRUE(world.ClaimFor(1, 10, 5, nullptr).accepted);

  const Claim other = world.ClaimFor(1, 11, 6, &name);
  EXPECT_FALSE(other.accepted);
  EXPECT_TRUE(other.may_wait);
  EXPECT_EQ(other.reason, v1::REJECTED_ID_OWNED);
  EXPECT_FALSE(world.ClaimFor(1, 11, 5, &name).may_wait);

  world.Find(1)->alive = false;
  EXPECT_EQ(world.ClaimFor(1, 11, 5, &name).reason, v1::REJECTED_ID_OWNED);
  const Claim successor = world.ClaimFor(1, 11, 6, &name);
  EXPECT_TRUE(successor.accepted);
  EXPECT_TRUE(successor.new_run);
}

TEST(World, ALowerRunIsOldAndAHigherOneStartsAnew) {
  World world(Simulated(1));
  const std::string name = "a";
  world.ClaimFor(1, 10, 5, &name);
  EXPECT_EQ(world.ClaimFor(1, 10, 4, &name).reason, v1::REJECTED_OLD_RUN);
  const Claim higher = world.ClaimFor(1, 10, 6, nullptr);
  EXPECT_TRUE(higher.accepted);
  EXPECT_TRUE(higher.new_run);
  higher.simulator->slots[70];
  higher.simulator->StartRun(10, 6);
  EXPECT_TRUE(higher.simulator->slots.empty());
  EXPECT_EQ(higher.simulator->name, "a");
  EXPECT_TRUE(higher.simulator->chunks_changed.contains(1));
}

// Goal:   who only sent states has proved nothing: a named message takes the id from it.
TEST(World, OnlyANameProvesOwnership) {
  World world(Simulated(1));
  const std::string name = "a";
  EXPECT_TRUE(world.ClaimFor(1, 66, 9, nullptr).accepted);
  EXPECT_FALSE(world.ClaimFor(1, 10, 1, nullptr).accepted);
  const Claim named = world.ClaimFor(1, 10, 1, &name);
  EXPECT_TRUE(named.accepted);
  EXPECT_TRUE(named.new_run);
}

TEST(World, HoldsNoMoreSimulatorsThanAllowedAndForgetsThoseThatLeft) {
  World world(Simulated(1));
  const std::string name = "a";
  for (const std::uint64_t id : {1, 2, 3}) EXPECT_TRUE(world.ClaimFor(id, id, 1, &name).accepted);
  const Claim refused = world.ClaimFor(4, 4, 1, &name);
  EXPECT_EQ(refused.simulator, nullptr);
  EXPECT_EQ(refused.reason, v1::REJECTED_TOO_MANY_SIMULATORS);
  world.Find(2)->alive = false;
  EXPECT_TRUE(world.ClaimFor(4, 4, 1, &name).accepted);
  EXPECT_EQ(world.Find(2), nullptr);
}

// Goal:   a clock counts once everything written before it has arrived, in order, and clocks that
// wait are few.
TEST(Simulator, AClockWaitsForWhatItVouchesFor) {
  Simulator simulator;
  simulator.OfferClock({.clock = At(1), .states_sequence = 2});
  simulator.OfferClock({.clock = At(2), .states_sequence = 2, .descriptions_sequence = 1});
  simulator.OfferClock({.clock = At(3), .states_sequence = 5});
  EXPECT_FALSE(simulator.TakeClock());
  simulator.states_seen = 3;
  EXPECT_TRUE(simulator.TakeClock());
  EXPECT_EQ(simulator.clock, At(1));
  simulator.descriptions_seen = 1;
  EXPECT_TRUE(simulator.TakeClock());
  EXPECT_EQ(simulator.clock, At(2));
  for (int i = 4; i < 100; ++i) simulator.OfferClock({.clock = At(i), .states_sequence = 5});
  EXPECT_EQ(simulator.pending.size(), kPendingClocksMax);
  simulator.states_seen = 5;
  EXPECT_TRUE(simulator.TakeClock());
  EXPECT_EQ(simulator.clock, At(99));
}

// Goal:   now is the least clock once all that are awaited have spoken, and never goes back.
TEST(World, SimulatedTimeIsTheLeastClock) {
  World world(Simulated(2));
  Simulator& a = Join(&world, 1, 10, 5);
  world.UpdateSimulatedTime();
  EXPECT_FALSE(world.started());
  Join(&world, 2, 20, 3);
  world.UpdateSimulatedTime();
  EXPECT_TRUE(world.started());
  EXPECT_EQ(world.now(), At(3));
  Join(&world, 3, 30, 1);
  world.UpdateSimulatedTime();
  EXPECT_EQ(world.now(), At(3));
  EXPECT_EQ(a.clock, At(5));
}

// Goal:   a silent simulator holds the world unless it left properly, or is released after its
// time.
TEST(World, ASilentSimulatorHoldsTimeUntilReleased) {
  for (const auto policy : {v1::Clock::WAIT, v1::Clock::RELEASE}) {
    World world(Simulated(2, policy));
    Join(&world, 1, 10, 7);
    Simulator& silent = Join(&world, 2, 20, 3);
    silent.agents = 1;
    world.SetReading({.monotonic_ns = kSecond});
    silent.alive = false;
    silent.silent_since_ns = kSecond;
    world.SetReading({.monotonic_ns = 6 * kSecond - 1});
    EXPECT_TRUE(world.ReleaseSilent().empty());
    EXPECT_EQ(world.WaitedFor(), std::vector<std::string>{"simulator 2"});
    world.SetReading({.monotonic_ns = 6 * kSecond});
    EXPECT_EQ(world.ReleaseSilent().size(), policy == v1::Clock::RELEASE ? 1u : 0u);
    EXPECT_EQ(world.WaitedFor().size(), policy == v1::Clock::RELEASE ? 0u : 1u);
    EXPECT_EQ(world.ReleaseSilent().size(), 0u);
    world.UpdateSimulatedTime();
    EXPECT_EQ(world.now(), At(policy == v1::Clock::RELEASE ? 7 : 3));
    silent.agents = 0;
    EXPECT_TRUE(world.WaitedFor().empty());
    world.UpdateSimulatedTime();
    EXPECT_EQ(world.now(), At(7));
  }
}

// Goal:   grants follow the least clearance, give at least Δt, at most grant_ahead_max, and are
// never withdrawn.
TEST(World, GrantsWhatIsClear) {
  World world(Simulated(1));
  Simulator& a = Join(&world, 1, 10, 0);
  Slot& slot = a.slots[0];
  slot.agent.emplace();
  slot.agent->clearance.emplace();
  slot.agent->clearance->clear_until = At(4 * kSecond);
  world.UpdateSimulatedTime();
  world.UpdateGrants();
  EXPECT_EQ(a.granted, At(4 * kSecond));
  EXPECT_TRUE(a.chunks_changed.contains(0));
  EXPECT_EQ(world.EffectiveFrom(At(1)), At(4 * kSecond));

  slot.agent->clearance->clear_until = At(0);
  world.UpdateGrants();
  EXPECT_EQ(a.granted, At(4 * kSecond));

  a.OfferClock({.clock = At(4 * kSecond)});
  world.TakeClock(&a);
  world.UpdateSimulatedTime();
  world.UpdateGrants();
  EXPECT_EQ(a.granted, At(4'016'666'666));

  slot.agent->clearance->clear_until = Instant::Never();
  world.UpdateGrants();
  EXPECT_EQ(a.granted, At(14 * kSecond));
}

// Goal:   stamps and clocks are allowed up to what is granted; before a grant, as far as any
//         service may have granted; who does not step in lock-step, as far as grants ever reach.
TEST(World, AllowsWhatIsGranted) {
  World world(Simulated(1));
  const std::string name = "a";
  Simulator& a = *world.ClaimFor(1, 10, 1, &name).simulator;
  EXPECT_EQ(world.RulesForClock(a).latest, Instant::Never());
  Join(&world, 1, 10, 0);
  EXPECT_EQ(world.RulesForState(a, true).latest, At(10 * kSecond));
  a.granted = At(2 * kSecond);
  world.UpdateSimulatedTime();
  a.lock_step = true;
  EXPECT_EQ(world.RulesForState(a, true).latest, At(2 * kSecond));
  EXPECT_EQ(world.RulesForClock(a).earliest, At(0));
  EXPECT_EQ(world.RulesForState(a, true).discontinuity_from, At(0));
  a.lock_step = false;
  EXPECT_EQ(world.RulesForClock(a).latest, At(10 * kSecond));

  Simulator& inherited = Join(&world, 2, 20, 7 * kSecond);
  inherited.lock_step = true;
  inherited.granted = At(1 * kSecond);
  EXPECT_EQ(world.RulesForClock(inherited).latest, At(17 * kSecond));
}

// Goal:   who does not step in lock-step may run ahead by grant_ahead_max and no further, however
//         often it moves its clock: of now, or before the run has started, of its first clock.
TEST(World, NobodyRunsFurtherAheadThanAllowed) {
  World world(Simulated(2));
  Simulator& a = Join(&world, 1, 10, 3 * kSecond);
  const auto advance_to = [&world, &a](std::int64_t clock_ns) {
    a.OfferClock({.clock = At(clock_ns)});
    EXPECT_TRUE(world.TakeClock(&a));
    world.UpdateSimulatedTime();
    world.UpdateGrants();
  };
  advance_to(12 * kSecond);
  EXPECT_EQ(world.RulesForClock(a).latest, At(13 * kSecond));

  Simulator& b = Join(&world, 2, 20, 4 * kSecond);
  advance_to(13 * kSecond);
  ASSERT_EQ(world.now(), At(4 * kSecond));
  EXPECT_EQ(world.RulesForClock(a).latest, At(14 * kSecond));
  advance_to(14 * kSecond);
  EXPECT_EQ(world.RulesForClock(a).latest, At(14 * kSecond));
  EXPECT_EQ(world.RulesForState(a, true).latest, At(14 * kSecond));

  b.OfferClock({.clock = At(6 * kSecond)});
  world.TakeClock(&b);
  world.UpdateSimulatedTime();
  EXPECT_EQ(world.RulesForClock(a).latest, At(16 * kSecond));
}

TEST(World, WallTimeFollowsTheMonotonicClock) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::WALL);
  config.mutable_clock()->set_skew_max_s(0.002);
  World world(CompleteConfig(config));
  world.SetReading({.wall_ns = 1000 * kSecond, .monotonic_ns = 1 * kSecond});
  EXPECT_EQ(world.now(), At(1000 * kSecond));
  world.SetReading({.wall_ns = 5000 * kSecond, .monotonic_ns = 3 * kSecond});
  EXPECT_EQ(world.now(), At(1002 * kSecond));
  EXPECT_EQ(world.RulesForState({}, true).latest, At(1002 * kSecond + 2'000'000));
  EXPECT_EQ(world.EffectiveFrom(At(1)), world.now());
}

}  // namespace
}  // namespace collision::server
