// Goal:   samples are numbered without a gap, an answer is published once, and a chunk that holds
//         the grant leaves after the others.
// Method: a publisher on a scripted bus, with one simulator that has changed several chunks.
#include "server/publish/publisher.h"

#include <gtest/gtest.h>

#include <set>

#include "server/codec/encode.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

v1::Config Config() {
  v1::Config config;
  return CompleteConfig(config);
}

/// Service 7, in its term 3.
ServiceClaim Claimed() {
  ServiceClaim claim({.instance = 7, .term_before = 2});
  claim.Update(0);
  return claim;
}

/// The numbers of the chunks published so far, in order.
std::vector<std::uint32_t> Chunks(const ScriptedBus& bus) {
  std::vector<std::uint32_t> chunks;
  for (const v1::Output& output : bus.outputs) {
    if (output.has_clearance()) chunks.push_back(output.clearance().chunk());
  }
  return chunks;
}

/// A world whose time has begun, with one simulator in lock-step.
struct OneSimulator {
  explicit OneSimulator(const v1::Config& config = Config()) : world(config) {
    const std::string name = "a";
    simulator = world.ClaimFor(1, 10, 1, &name).simulator;
    simulator->time().Offer({.clock = At(0)});
    EXPECT_TRUE(simulator->time().Take());
    world.MoveOn();
  }

  World world;
  Simulator* simulator = nullptr;
};

/// The first revision of an event about the pair in this slot.
detection::CollisionEvent InSlot(std::uint32_t slot, detection::EventStatus status = {}) {
  detection::CollisionEvent event;
  event.pair_slot = slot;
  event.lower.slot = slot;
  event.status = status;
  return event;
}

TEST(Publisher, EverySampleCarriesServiceTermAndTheNextNumber) {
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher publisher(Config(), &claim, &bus);
  const World world(Config());
  publisher.PublishEvents({InSlot(1), InSlot(2)}, world);
  publisher.PublishRejections({v1::Rejection{}});
  publisher.PublishStatus({});
  ASSERT_EQ(bus.outputs.size(), 4u);
  const v1::ServiceStamp stamps[] = {
      bus.outputs[0].collision_event().stamp(), bus.outputs[1].collision_event().stamp(),
      bus.outputs[2].rejection().stamp(), bus.outputs[3].service_status().stamp()};
  for (std::uint64_t i = 0; i < 4; ++i) {
    EXPECT_EQ(stamps[i].service_id(), 7u);
    EXPECT_EQ(stamps[i].term(), 3u);
    EXPECT_EQ(stamps[i].sequence(), i + 1);
  }
  EXPECT_EQ(bus.outputs[3].service_status().service_id(), 7u);
}

TEST(Publisher, AnEarliestAnswerIsPublishedOnceUntilItChanges) {
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher publisher(Config(), &claim, &bus);
  OneSimulator one;
  one.world.MoveTo(At(1));
  publisher.PublishEarliest({}, one.world);
  one.world.MoveTo(At(2));
  publisher.PublishEarliest({}, one.world);
  ASSERT_EQ(bus.outputs.size(), 1u);
  EXPECT_EQ(bus.outputs[0].earliest_intersection().now_ns(), 1);
  one.world.MoveTo(At(3));
  publisher.PublishEarliest({.found = true, .earliest = At(5), .lower = {}, .higher = {}},
                            one.world);
  ASSERT_EQ(bus.outputs.size(), 2u);
  EXPECT_EQ(bus.outputs[1].earliest_intersection().now_ns(), 3);
  EXPECT_EQ(bus.outputs[1].earliest_intersection().earliest_ns(), 5);
}

TEST(Publisher, AnEarliestAnswerIsDueOncePerPeriodOfEitherTimeAndForNewReaders) {
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher publisher(Config(), &claim, &bus);
  OneSimulator one;
  constexpr std::int64_t kPeriod = kSecond / 10;  // the default
  bus.earliest_read_by = 0;
  EXPECT_FALSE(publisher.EarliestIsDue(one.world));
  bus.earliest_read_by = 1;
  EXPECT_TRUE(publisher.EarliestIsDue(one.world));
  publisher.PublishEarliest({}, one.world);
  EXPECT_FALSE(publisher.EarliestIsDue(one.world));
  one.world.MoveTo(At(kPeriod - 1));
  EXPECT_FALSE(publisher.EarliestIsDue(one.world));
  one.world.MoveTo(At(kPeriod));
  EXPECT_TRUE(publisher.EarliestIsDue(one.world));
  publisher.PublishEarliest({}, one.world);
  EXPECT_FALSE(publisher.EarliestIsDue(one.world));
  one.world.SetReading({.monotonic_ns = kPeriod});
  EXPECT_TRUE(publisher.EarliestIsDue(one.world));
  publisher.PublishEarliest({}, one.world);
  ASSERT_EQ(bus.outputs.size(), 1u);
  bus.earliest_read_by = 2;
  EXPECT_TRUE(publisher.EarliestIsDue(one.world));
  publisher.PublishEarliest({}, one.world);
  EXPECT_EQ(bus.outputs.size(), 2u);
}

TEST(Publisher, ContactsAreNumberedInOneInstanceAndClearancesNameTheLast) {
  OneSimulator one;
  one.simulator->agents().clearances().MarkChanged(0);
  one.simulator->time().Grant(At(kSecond));
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher publisher(Config(), &claim, &bus);
  using enum detection::EventStatus;
  publisher.PublishEvents({InSlot(3, kConfirmed), InSlot(4), InSlot(3, kEnded)}, one.world);
  publisher.PublishClearances(&one.world);
  ASSERT_EQ(bus.outputs.size(), 4u);
  const v1::CollisionEvent& confirmed = bus.outputs[0].collision_event();
  const v1::CollisionEvent& ended = bus.outputs[1].collision_event();
  const v1::CollisionEvent& forecast = bus.outputs[2].collision_event();
  EXPECT_EQ(confirmed.contacts_sequence(), 1u);
  EXPECT_EQ(ended.contacts_sequence(), 2u);
  EXPECT_EQ(confirmed.pair_slot(), 0u);
  EXPECT_EQ(ended.pair_slot(), 0u);
  EXPECT_EQ(forecast.contacts_sequence(), 0u);
  EXPECT_EQ(forecast.pair_slot(), 4u);
  EXPECT_EQ(bus.outputs[3].clearance().contacts_sequence(), 2u);
  EXPECT_EQ(publisher.event_counters().contacts, 2u);
  EXPECT_EQ(publisher.event_counters().forecasts, 1u);
}

// Goal:   events of a level have its name and slots of their own; crossings share the history.
TEST(Publisher, LevelsShareTheHistoryAndNoSlot) {
  v1::Config config = Config();
  for (const char* name : {"near", "far"}) {
    config.add_levels()->set_name(name);
    config.mutable_levels()->rbegin()->set_margin_m(1);
  }
  OneSimulator one(config);
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher publisher(config, &claim, &bus);
  using enum detection::EventStatus;
  publisher.PublishEvents({InSlot(3, kConfirmed), InSlot(4)}, one.world);
  publisher.PublishLevelEvents(0, {InSlot(3, kConfirmed), InSlot(4)}, one.world);
  publisher.PublishLevelEvents(1, {InSlot(4), InSlot(5)}, one.world);
  std::set<std::uint32_t> slots;
  std::string levels;
  std::uint64_t contacts = 0;
  for (const v1::Output& output : bus.outputs) {
    const v1::CollisionEvent& event = output.collision_event();
    levels += event.level() + " ";
    if (event.contacts_sequence() > 0) {
      EXPECT_EQ(event.contacts_sequence(), ++contacts);
    } else {
      EXPECT_TRUE(slots.insert(event.pair_slot()).second) << event.pair_slot();
    }
  }
  EXPECT_EQ(levels, "  near near far far ");
  EXPECT_EQ(contacts, 2u);
}

// Goal:   a standby keeps crossings of levels apart from contacts: what the other service has told
//         of one is not taken for the other.
TEST(Publisher, AStandbyTellsOfEachLevelWhatTheOtherServiceHasNot) {
  v1::Config config = Config();
  config.add_levels()->set_name("near");
  config.mutable_levels(0)->set_margin_m(1);
  OneSimulator one(config);
  ScriptedBus bus;
  ServiceClaim claim({.instance = 8, .wait_ns = kSecond});
  Publisher publisher(config, &claim, &bus);
  ASSERT_FALSE(claim.speaks());
  using enum detection::EventStatus;
  publisher.PublishEvents({InSlot(3, kConfirmed)}, one.world);
  publisher.PublishLevelEvents(0, {InSlot(3, kConfirmed)}, one.world);
  v1::Input heard;
  *heard.mutable_event_heard() = Encode(InSlot(3, kConfirmed));
  heard.mutable_event_heard()->set_contacts_sequence(5);
  heard.mutable_event_heard()->mutable_stamp()->set_epoch(1);
  publisher.Hear(heard);
  publisher.PublishInherited(&one.world);
  std::string told;
  for (const v1::Output& output : bus.outputs) {
    told += "[" + output.collision_event().level() + "] ";
  }
  EXPECT_EQ(told, "[] [near] ") << "one as the other service told it, one that it did not tell";
}

TEST(Publisher, TheEventLogCountsEventsWithoutTheirStamps) {
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher one(Config(), &claim, &bus), late(Config(), &claim, &bus);
  late.PublishStatus({});  // its later samples have other numbers
  const World world(Config());
  one.PublishEvents({{}}, world);
  late.PublishEvents({{}}, world);
  EXPECT_EQ(one.event_log().count(), 1u);
  EXPECT_EQ(one.event_log().hash(), late.event_log().hash());
  detection::CollisionEvent other;
  other.revision = 2;
  late.PublishEvents({other}, world);
  EXPECT_NE(one.event_log().hash(), late.event_log().hash());
}

TEST(Publisher, TheChunkOfTheGrantLeavesLastAndEachOnce) {
  OneSimulator one;
  (void)one.simulator->agents().clearances().TakeChanged(0, 0, {});
  one.simulator->time().Grant(At(kSecond));
  for (const std::uint32_t slot : {0u, 64u, 200u}) {
    one.simulator->agents().clearances().MarkChanged(slot);
  }
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher publisher(Config(), &claim, &bus);
  publisher.PublishClearances(&one.world);
  EXPECT_EQ(Chunks(bus), (std::vector<std::uint32_t>{3, 1, 0}));
  EXPECT_EQ(bus.outputs.back().clearance().granted_until_ns(), kSecond);
  publisher.PublishClearances(&one.world);
  EXPECT_EQ(bus.outputs.size(), 3u);
}

TEST(Publisher, AClearanceThatRisesWaitsByTheWallClockOnly) {
  for (const bool wall : {false, true}) {
    v1::Config config;
    if (wall) config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
    config = CompleteConfig(config);
    OneSimulator one(config);
    one.simulator->time().Grant(At(kSecond));
    AgentTable& agents = one.simulator->agents();
    agents.Add(0, {1, 1, detection::AgentDeclaration{}});
    agents.Admit(0, At(0), 1);
    const detection::AgentId id = one.simulator->IdOf(0, 1);
    agents.SetClearance({.agent = id, .clear_until = At(kSecond)});
    ScriptedBus bus;
    const ServiceClaim claim = Claimed();
    Publisher publisher(config, &claim, &bus);
    publisher.PublishClearances(&one.world);
    EXPECT_EQ(Chunks(bus).size(), 1u);
    agents.SetClearance({.agent = id, .clear_until = At(2 * kSecond)});
    publisher.PublishClearances(&one.world);
    EXPECT_EQ(Chunks(bus).size(), wall ? 1u : 2u);
    one.world.SetReading({kSecond, kSecond});
    publisher.PublishClearances(&one.world);
    EXPECT_EQ(Chunks(bus).size(), 2u);
  }
}

TEST(Publisher, ASimulatorWithoutAGrantKeepsItsMarks) {
  OneSimulator one;
  one.simulator->agents().clearances().MarkChanged(64);
  ScriptedBus bus;
  const ServiceClaim claim = Claimed();
  Publisher publisher(Config(), &claim, &bus);
  publisher.PublishClearances(&one.world);
  EXPECT_EQ(Chunks(bus), std::vector<std::uint32_t>{});
  one.simulator->time().Grant(At(kSecond));
  publisher.PublishClearances(&one.world);
  EXPECT_EQ(Chunks(bus), (std::vector<std::uint32_t>{1}));
}

}  // namespace
}  // namespace collision::server
