#include "server/world/world.h"

#include <gtest/gtest.h>

#include <set>

#include "server/config/config.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

v1::Config Simulated(std::uint32_t awaited, v1::Clock::OnSilent on_silent = v1::Clock::WAIT) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::LOCK_STEP);
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
  simulator.time().Offer({.clock = At(clock_ns)});
  EXPECT_TRUE(simulator.time().Take());
  return simulator;
}

// Goal:   time begins once as many simulators as are awaited are there; where it had begun before
//         the service started, it goes on with those of the roster, however few.
TEST(World, WhatIsAwaitedComesOnce) {
  World world(Simulated(2));
  EXPECT_EQ(world.SimulatorsToCome(), 0u) << "nobody waits";
  Join(&world, 1, 10, 0);
  EXPECT_EQ(world.SimulatorsToCome(), 1u);
  EXPECT_EQ(world.NextNow(), std::nullopt);
  Join(&world, 2, 20, 0);
  EXPECT_EQ(world.SimulatorsToCome(), 0u);
  EXPECT_EQ(world.NextNow(), At(0));

  JournalledSimulator one;
  one.id = 1;
  one.run = 1;
  one.granted = At(kSecond);
  World again(Simulated(2), {one});
  Join(&again, 1, 10, kSecond);
  again.ReleaseSilent();
  EXPECT_EQ(again.SimulatorsToCome(), 0u);
  EXPECT_EQ(again.NextNow(), At(kSecond));
}

// Goal:   an id belongs to the first sender that named itself, until it is gone and a higher run
//         comes.
TEST(World, AnIdHasOneOwner) {
  World world(Simulated(1));
  const std::string name = "a";
  EXPECT_TRUE(world.ClaimFor(1, 10, 5, &name).accepted);
  EXPECT_TRUE(world.ClaimFor(1, 10, 5, nullptr).accepted);

  const Claim other = world.ClaimFor(1, 11, 6, &name);
  EXPECT_FALSE(other.accepted);
  EXPECT_EQ(other.reason, v1::REJECTED_ID_OWNED);

  world.Find(1)->SetAlive(false, 0);
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
  higher.simulator->agents().SetWaiting(70, {}, AgentTable::Former::kReplaced);
  higher.simulator->StartRun(10, 6);
  EXPECT_EQ(higher.simulator->agents().Waiting(70), nullptr);
  EXPECT_EQ(higher.simulator->run(), 6u);
  EXPECT_EQ(higher.simulator->name(), "a");
  EXPECT_TRUE(higher.simulator->agents().clearances().TakeChanged(0, 0, {}).contains(1));
}

// Goal:   states alone prove nothing: they make no simulator and take over none, but are not
//         refused either, since the name may come.
TEST(World, OnlyANameProvesOwnership) {
  World world(Simulated(1));
  const std::string name = "a";
  const Claim ghost = world.ClaimFor(1, 66, 9, nullptr);
  EXPECT_FALSE(ghost.accepted);
  EXPECT_TRUE(ghost.unproven);
  EXPECT_TRUE(world.simulators().empty());
  EXPECT_TRUE(world.ClaimFor(1, 10, 1, &name).accepted);
  EXPECT_FALSE(world.ClaimFor(1, 66, 9, nullptr).unproven);
  world.Find(1)->SetAlive(false, 0);
  EXPECT_TRUE(world.ClaimFor(1, 66, 9, nullptr).unproven);
  EXPECT_FALSE(world.ClaimFor(1, 66, 9, nullptr).accepted);
  EXPECT_TRUE(world.ClaimFor(1, 66, 9, &name).new_run);
}

TEST(World, HoldsNoMoreSimulatorsThanAllowedAndForgetsThoseThatLeft) {
  World world(Simulated(1));
  const std::string name = "a";
  for (const std::uint64_t id : {1, 2, 3}) EXPECT_TRUE(world.ClaimFor(id, id, 1, &name).accepted);
  const Claim refused = world.ClaimFor(4, 4, 1, &name);
  EXPECT_EQ(refused.simulator, nullptr);
  EXPECT_EQ(refused.reason, v1::REJECTED_TOO_MANY_SIMULATORS);
  world.Find(2)->SetAlive(false, 0);
  EXPECT_TRUE(world.ClaimFor(4, 4, 1, &name).accepted);
  EXPECT_EQ(world.Find(2), nullptr);
  EXPECT_EQ(world.TakeForgotten(), std::vector<std::uint64_t>{2});
  EXPECT_TRUE(world.TakeForgotten().empty());
  // One that comes back in the same step is not forgotten.
  world.Find(1)->SetAlive(false, 0);
  EXPECT_TRUE(world.ClaimFor(2, 2, 2, &name).accepted);
  world.Find(4)->SetAlive(false, 0);
  EXPECT_TRUE(world.ClaimFor(1, 1, 2, &name).accepted);
  EXPECT_EQ(world.TakeForgotten(), std::vector<std::uint64_t>{4});
}

// Goal:   now is the least clock once all awaited simulators have sent one, and never goes back.
TEST(World, SimulatedTimeIsTheLeastClock) {
  World world(Simulated(2));
  Simulator& a = Join(&world, 1, 10, 5);
  world.MoveOn();
  EXPECT_FALSE(world.started());
  Join(&world, 2, 20, 3);
  world.MoveOn();
  EXPECT_TRUE(world.started());
  EXPECT_EQ(world.now(), At(3));
  Join(&world, 3, 30, 1);
  world.MoveOn();
  EXPECT_EQ(world.now(), At(3));
  EXPECT_EQ(a.time().clock(), At(5));
}

// Goal:   a silent simulator holds the world unless it left properly, or is released after its
// time.
TEST(World, ASilentSimulatorHoldsTimeUntilReleased) {
  for (const auto policy : {v1::Clock::WAIT, v1::Clock::RELEASE}) {
    World world(Simulated(2, policy));
    Join(&world, 1, 10, 7);
    Simulator& silent = Join(&world, 2, 20, 3);
    silent.agents().Add(0, {1, 1, {}});
    world.SetReading({.monotonic_ns = kSecond});
    silent.SetAlive(false, kSecond);
    world.SetReading({.monotonic_ns = 6 * kSecond - 1});
    EXPECT_TRUE(world.ReleaseSilent().empty());
    EXPECT_EQ(world.Waited(), (std::vector<Awaited>{{"simulator 2", WaitReason::kEnded}}));
    world.SetReading({.monotonic_ns = 6 * kSecond});
    EXPECT_EQ(world.ReleaseSilent().size(), policy == v1::Clock::RELEASE ? 1u : 0u);
    EXPECT_EQ(world.Waited().size(), policy == v1::Clock::RELEASE ? 0u : 1u);
    EXPECT_EQ(world.ReleaseSilent().size(), 0u);
    world.MoveOn();
    EXPECT_EQ(world.now(), At(policy == v1::Clock::RELEASE ? 7 : 3));
    silent.agents().Remove(0);
    EXPECT_TRUE(world.Waited().empty());
    world.MoveOn();
    EXPECT_EQ(world.now(), At(7));
  }
}

// Goal:   one that is there after a take-over is not said to be missing.
TEST(World, AfterATakeOverItTellsWhoIsThereFromWhoIsNot) {
  World world(Simulated(2, v1::Clock::WAIT));
  Join(&world, 1, 10, 7);
  Simulator& silent = Join(&world, 2, 20, 3);
  silent.agents().Add(0, {1, 1, {}});
  silent.SetAlive(false, 0);
  world.TakeOver();
  EXPECT_EQ(world.Waited(), (std::vector<Awaited>{{"simulator 1", WaitReason::kDoesNotFollowYet},
                                                  {"simulator 2", WaitReason::kEnded}}));
}

// Goal:   grants follow the least clearance, give at least Δt, at most grant_ahead_max, and are
// never withdrawn.
TEST(World, GrantsWhatIsClear) {
  World world(Simulated(1));
  Simulator& a = Join(&world, 1, 10, 0);
  a.agents().Add(0, {1, 1, {}});
  a.agents().Admit(0, At(0), 1);
  const auto clear_until = [&world, &a](Instant instant) {
    world.SetClearance({.agent = a.IdOf(0, 1), .clear_until = instant});
    EXPECT_EQ(a.agents().clearances().TakeChanged(0, 0, {}), std::set<std::uint32_t>{0});
  };
  clear_until(At(4 * kSecond));
  world.MoveOn();
  world.UpdateGrants();
  EXPECT_EQ(a.time().granted(), At(4 * kSecond));
  EXPECT_TRUE(a.agents().clearances().TakeChanged(0, 0, {}).contains(0));
  EXPECT_EQ(world.EffectiveFrom(At(1)), At(4 * kSecond));

  clear_until(At(0));
  world.UpdateGrants();
  EXPECT_EQ(a.time().granted(), At(4 * kSecond));
  EXPECT_TRUE(a.agents().clearances().TakeChanged(0, 0, {}).empty())
      << "a grant that stays is not told again";

  a.time().Offer({.clock = At(4 * kSecond)});
  EXPECT_TRUE(a.time().Take());
  world.MoveOn();
  world.UpdateGrants();
  EXPECT_EQ(a.time().granted(), At(4'016'666'666));

  a.agents().clearances().MarkGrantChanged();
  clear_until(Instant::Never());
  world.UpdateGrants();
  EXPECT_EQ(a.time().granted(), At(14 * kSecond));
  world.Validate();
}

// Goal:   stamps and clocks are allowed up to what is granted; before a grant, as far as any
//         service may have granted; without lock-step, as far as grants ever reach.
TEST(World, AllowsWhatIsGranted) {
  World world(Simulated(1));
  const std::string name = "a";
  Simulator& a = *world.ClaimFor(1, 10, 1, &name).simulator;
  EXPECT_EQ(world.RulesForClock(a).latest, At(365 * 86400 * kSecond));
  Join(&world, 1, 10, 0);
  EXPECT_EQ(world.RulesForState(a, true).latest, At(10 * kSecond));
  a.time().Grant(At(2 * kSecond));
  world.MoveOn();
  a.time().Offer({.clock = At(0), .lock_step = true});
  EXPECT_EQ(world.RulesForState(a, true).latest, At(2 * kSecond));
  EXPECT_EQ(world.RulesForClock(a).earliest, At(0));
  EXPECT_EQ(world.RulesForState(a, true).discontinuity_from, At(0));
  a.time().Offer({.clock = At(0), .lock_step = false});
  EXPECT_EQ(world.RulesForClock(a).latest, At(10 * kSecond));

  Simulator& inherited = Join(&world, 2, 20, 7 * kSecond);
  inherited.time().Offer({.clock = At(7 * kSecond), .lock_step = true});
  inherited.time().Grant(At(1 * kSecond));
  EXPECT_EQ(world.RulesForClock(inherited).latest, At(17 * kSecond));
}

// Goal:   without lock-step a simulator may run ahead by grant_ahead_max and no further, however
//         often it moves its clock: ahead of now or, before there is one, of its first clock.
TEST(World, NoSimulatorRunsFurtherAheadThanAllowed) {
  World world(Simulated(2));
  Simulator& a = Join(&world, 1, 10, 3 * kSecond);
  const auto advance_to = [&world, &a](std::int64_t clock_ns) {
    a.time().Offer({.clock = At(clock_ns)});
    EXPECT_TRUE(a.time().Take());
    world.MoveOn();
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

  b.time().Offer({.clock = At(6 * kSecond)});
  EXPECT_TRUE(b.time().Take());
  world.MoveOn();
  EXPECT_EQ(world.RulesForClock(a).latest, At(16 * kSecond));
}

TEST(World, WallTimeFollowsTheWallClock) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_skew_max_s(0.002);
  World world(CompleteConfig(config));
  const Simulator one(1, 1, 1, "a");
  EXPECT_FALSE(world.SetReading({.wall_ns = 1000 * kSecond, .monotonic_ns = 1 * kSecond}));
  EXPECT_EQ(world.now(), At(1000 * kSecond));
  EXPECT_FALSE(world.SetReading({.wall_ns = 1002 * kSecond, .monotonic_ns = 3 * kSecond}));
  EXPECT_EQ(world.now(), At(1002 * kSecond));
  EXPECT_EQ(world.RulesForState(one, true).latest, At(1002 * kSecond + 2'000'000));
  EXPECT_EQ(world.EffectiveFrom(At(1)), world.now());
  const auto step = world.SetReading({.wall_ns = 5000 * kSecond, .monotonic_ns = 3 * kSecond});
  ASSERT_TRUE(step && step->breaks);
  EXPECT_EQ(world.now(), At(1002 * kSecond));
  world.BeginEpoch();
  EXPECT_EQ(world.now(), At(5000 * kSecond));
  EXPECT_EQ(world.epoch(), 2u);
  EXPECT_EQ(world.RulesForState(one, true).earliest, At(5000 * kSecond - 2'000'000));
}

// Goal:   an echo tells of an offset only if its sample is of this service and on the time scale of
//         now: anything else would accuse a sender, or excuse it, wrongly.
TEST(World, AnEchoCountsIfItsSampleIsOnThePresentTimeScale) {
  constexpr std::uint64_t kService = 7;
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_skew_max_s(0.002);
  World world(CompleteConfig(config));
  std::int64_t wall_ns = 1000 * kSecond, steady_ns = 0;
  const auto pass = [&](std::int64_t ns, std::int64_t set_ns = 0) {
    wall_ns += ns + set_ns;
    steady_ns += ns;
    world.SetReading({.wall_ns = wall_ns, .monotonic_ns = steady_ns});
  };
  pass(kSecond);
  v1::SimulatorClock clock;
  const auto has_echo = [&] {
    const auto trip = world.RoundTripOf(clock, kService);
    EXPECT_TRUE(trip.has_value());
    return trip && trip->asked;
  };
  EXPECT_FALSE(world.RoundTripOf(clock, kService)) << "it says nothing";
  clock.set_sent_ns(wall_ns - 10);
  clock.set_heard_ns(wall_ns - 20);
  clock.set_echo_ns(wall_ns - 30);
  clock.set_epoch(1);
  EXPECT_FALSE(has_echo()) << "of no service";
  clock.set_service_id(kService);
  EXPECT_TRUE(has_echo());
  EXPECT_EQ(world.RoundTripOf(clock, kService)->arrived, At(wall_ns));
  clock.set_epoch(2);
  EXPECT_FALSE(has_echo());
  clock.set_epoch(1);
  clock.set_echo_ns(wall_ns + 1);
  EXPECT_FALSE(has_echo()) << "of the future";
  clock.set_echo_ns(wall_ns);
  for (const std::int64_t by_ns : {1'000'000, -1'000'000}) {
    pass(kSecond, by_ns);
    EXPECT_FALSE(has_echo()) << "of before a step";
    pass(kSecond);
    clock.set_echo_ns(wall_ns);
    EXPECT_TRUE(has_echo());
  }
  clock.set_sent_ns(-1);
  EXPECT_FALSE(world.RoundTripOf(clock, kService));
}

// Goal:   who was not heard because the service stood still has some time to be heard.
TEST(World, ReleasesNobodyWhileItWakesUp) {
  v1::Config config;
  config.mutable_clock()->set_on_silent_simulator(v1::Clock::RELEASE);
  config.mutable_clock()->set_release_after_s(5);
  World world(CompleteConfig(config), {{.id = 1, .run = 1, .name = "alpha", .granted = {}}});
  const auto released_at = [&world](std::int64_t ns) {
    world.SetReading({ns, ns});
    return world.ReleaseSilent();
  };
  EXPECT_TRUE(released_at(0).empty());
  world.SetReading({9 * kWakingTime, 9 * kWakingTime});
  world.WakeUp();
  EXPECT_TRUE(world.ReleaseSilent().empty());
  EXPECT_EQ(world.NextRelease(), 10 * kWakingTime);
  EXPECT_EQ(released_at(10 * kWakingTime), std::vector<std::string>{"alpha"});
}

}  // namespace
}  // namespace collision::server
