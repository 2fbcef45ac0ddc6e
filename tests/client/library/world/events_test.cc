// Goal:   every revision of an event of ours comes once, on the caller's thread and inside its
//         call, and none after the end; without a callback they wait, up to a bound.
// Method: events on a network under the test's control, with repeats, strangers and late ones.
#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>

#include "client/library/world/world_implementation.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

class EventsTest : public testing::Test {
 protected:
  void Arrive(const v1::CollisionEvent& event) {
    *network_->arriving.emplace_back().mutable_collision_event() = event;
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  // In lock-step forecasts wait for the next step.
  World world_ = ConnectTo(network_, {.lock_step = false, .levels = {"near"}});
};

TEST_F(EventsTest, EachRevisionArrivesOnceAndOnlyForOwnAgents) {
  Arrive(OwnEvent(1, 1, 10));
  Arrive(OwnEvent(1, 1, 10));
  Arrive(OwnEvent(1, 2, 11));
  Arrive(OwnEvent(1, 1, 12));
  v1::CollisionEvent stranger = OwnEvent(1, 1, 13);
  stranger.set_pair_slot(1);
  stranger.mutable_lower()->set_simulator_id(5);
  Arrive(stranger);
  v1::CollisionEvent former = OwnEvent(1, 1, 14);
  former.set_pair_slot(2);
  former.mutable_lower()->set_run(kRun - 1);
  Arrive(former);
  world_.Poll();
  const std::vector<Event> events = world_.TakeEvents();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].revision, 1u);
  EXPECT_EQ(events[1].revision, 2u);
  EXPECT_TRUE(world_.TakeEvents().empty());
}

TEST_F(EventsTest, LevelsComeWhereTheyAreNamed) {
  v1::CollisionEvent near = OwnEvent(1, 1, 10), far = OwnEvent(1, 1, 11);
  near.set_level("near");
  far.set_level("far");
  World listener = ConnectTo(network_, {.lock_step = false});
  for (World* world : {&world_, &listener}) {
    Arrive(near);
    Arrive(far);
    Arrive(OwnEvent(1, 1, 12));
    world->Poll();
  }
  const auto levels = [](World* world) {
    std::vector<std::string> names;
    for (const Event& event : world->TakeEvents()) names.push_back(event.level);
    return names;
  };
  EXPECT_EQ(levels(&world_), (std::vector<std::string>{"near", ""}));
  EXPECT_EQ(levels(&listener), std::vector<std::string>{""});
}

TEST_F(EventsTest, AllFieldsArrive) {
  v1::CollisionEvent event = OwnEvent(3, 4, 10);
  event.set_now_ns(1);
  event.set_contacts_sequence(14);
  event.set_status(v1::EVENT_UNDECIDED);
  event.mutable_begin()->set_earliest_ns(2);
  event.mutable_begin()->set_latest_ns(3);
  event.mutable_end()->set_earliest_ns(4);
  event.mutable_end()->set_latest_ns(kNever);
  event.set_began_before(true);
  event.mutable_proximity()->set_at_ns(5);
  event.mutable_proximity()->mutable_separation_m()->set_lower(6);
  event.mutable_proximity()->mutable_separation_m()->set_upper(7);
  event.mutable_proximity()->set_depth_lower_m(8);
  event.mutable_proximity()->mutable_point_m()->set_y(9);
  event.mutable_proximity()->set_point_error_m(10);
  event.mutable_proximity()->mutable_normal()->mutable_direction()->set_z(1);
  event.mutable_proximity()->mutable_normal()->set_error_rad(11);
  event.set_tree_level(12);
  event.set_level("near");
  event.set_work_units(13);
  event.set_limited_by(v1::LIMIT_GEOMETRY);
  event.mutable_lower_label()->set_simulator_name(kSimulator);
  event.mutable_higher_label()->set_agent_name("bob");
  event.mutable_higher_label()->set_assembly("arm");
  event.mutable_higher_label()->add_tags()->set_key("kind");
  v1::KeyValue* because = event.add_extensions();
  because->set_key("because");
  because->set_value("silent");
  Arrive(event);
  world_.Poll();
  const Event received = world_.TakeEvents().at(0);
  EXPECT_EQ(received.lower, (AgentId{SimulatorId(kSimulator), kRun, 0, 1}));
  EXPECT_EQ(received.higher.simulator, 1u);
  EXPECT_EQ(received.lower_label.simulator, kSimulator);
  EXPECT_EQ(received.higher_label.name, "bob");
  EXPECT_EQ(received.higher_label.assembly, "arm");
  EXPECT_EQ(received.higher_label.tags, (std::vector<Tag>{{"kind", ""}}));
  EXPECT_EQ(world_.Name(received.higher), "bob");
  EXPECT_EQ(received.contact, 3u);
  EXPECT_EQ(received.revision, 4u);
  EXPECT_EQ(received.now_ns, 1);
  EXPECT_EQ(received.contacts_sequence, 14u);
  EXPECT_EQ(received.status, EventStatus::kUndecided);
  EXPECT_EQ(received.begin.earliest_ns, 2);
  EXPECT_EQ(received.begin.latest_ns, 3);
  EXPECT_EQ(received.end.earliest_ns, 4);
  EXPECT_EQ(received.end.latest_ns, kNever);
  EXPECT_FALSE(received.continuous);
  EXPECT_TRUE(received.began_before);
  EXPECT_EQ(received.proximity->at_ns, 5);
  EXPECT_EQ(received.proximity->separation_lower_m, 6);
  EXPECT_EQ(received.proximity->separation_upper_m, 7);
  EXPECT_EQ(received.proximity->depth_lower_m, 8);
  EXPECT_EQ(received.proximity->point_m, (Vector3{0, 9, 0}));
  EXPECT_EQ(received.proximity->point_error_m, 10);
  EXPECT_EQ(received.proximity->normal->direction, (Vector3{0, 0, 1}));
  EXPECT_EQ(received.proximity->normal->error_rad, 11);
  EXPECT_EQ(received.tree_level, 12u);
  EXPECT_EQ(received.level, "near");
  EXPECT_EQ(received.work_units, 13u);
  EXPECT_EQ(received.limited_by, EventLimit::kGeometry);
  EXPECT_EQ(received.because, "silent");
  EXPECT_STREQ(Name(received.limited_by), "geometry");
}

v1::CollisionEvent OfService(std::uint64_t id, std::uint32_t term, v1::CollisionEvent event) {
  event.mutable_stamp()->set_service_id(id);
  event.mutable_stamp()->set_term(term);
  return event;
}

// A restarted service counts from 1 again, in sequences and in revisions. What it tells once more
// is not new.
TEST_F(EventsTest, EventsOfARestartedServiceArrive) {
  Arrive(OwnEvent(1, 5, 100));
  Arrive(OfService(7, 2, OwnEvent(1, 1, 3)));
  Arrive(OfService(7, 2, OwnEvent(1, 2, 4)));
  world_.Poll();
  const std::vector<Event> events = world_.TakeEvents();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].revision, 2u);
}

// A standby that takes over publishes the complete current set: known events are not new.
TEST_F(EventsTest, RepetitionsOfANewTermAndSamplesOfAnOldOneAreDropped) {
  Arrive(OwnEvent(1, 5, 100));
  Arrive(OfService(2, 2, OwnEvent(1, 5, 1)));
  Arrive(OwnEvent(1, 6, 101));
  v1::CollisionEvent next = OfService(2, 2, OwnEvent(1, 6, 2));
  next.set_now_ns(77);
  Arrive(next);
  world_.Poll();
  const std::vector<Event> events = world_.TakeEvents();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].now_ns, 77);
}

TEST_F(EventsTest, ACallbackRunsInsideTheCallAndGetsTheKeptEvents) {
  Arrive(OwnEvent(1, 1, 1));
  world_.Poll();
  std::vector<std::uint32_t> revisions;
  world_.OnEvent([&](const Event& event) { revisions.push_back(event.revision); });
  EXPECT_TRUE(revisions.empty());
  Arrive(OwnEvent(1, 2, 2));
  world_.AdvanceTo(0, nanoseconds(0));
  EXPECT_EQ(revisions, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_TRUE(world_.TakeEvents().empty());
}

TEST_F(EventsTest, WaitingForAServiceRunsNoCallback) {
  int called = 0;
  world_.OnEvent([&](const Event&) { ++called; });
  network_->on_wait = [](FakeNetwork* network) { network->alive = true; };
  Arrive(OwnEvent(1, 1, 1));
  EXPECT_TRUE(world_.WaitForService(hours(1)));
  EXPECT_EQ(called, 0);
  world_.Poll();
  EXPECT_EQ(called, 1);
}

// An owner that bounces its agent: the jump goes out at the same clock, before time moves on.
TEST_F(EventsTest, AStateSetByACallbackCountsFromTheAnnouncedStepOn) {
  World world = ConnectTo(network_);
  Agent ball = world.AddAgent(Point(), {});
  world.Publish(0);
  ball.SetState({.stamp_ns = 50});
  world.OnEvent([&](const Event&) { ball.SetState({.stamp_ns = 50, .discontinuity = true}); });
  network_->on_wait = [this](FakeNetwork* network) {
    Arrive(OwnEvent(1, 1, 1));
    if (network->waits.size() > 3) network->Grant(50);
  };
  network_->written.clear();
  EXPECT_EQ(world.AdvanceTo(50, hours(1)), Advance::kReached);
  ASSERT_EQ(network_->written.size(), 2u);
  EXPECT_EQ(network_->written[0].simulator_clock().next_ns(), 50);
  const auto& states = network_->written[1].agent_states().states();
  ASSERT_EQ(states.size(), 2) << "behind the first state";
  EXPECT_TRUE(states[1].discontinuity());
  EXPECT_EQ(states[1].stamp_ns(), 50);
}

TEST_F(EventsTest, ACallbackMayNotWait) {
  int refused = 0;
  world_.OnEvent([&](const Event&) {
    EXPECT_THROW(world_.Poll(), std::logic_error);
    EXPECT_THROW(world_.AdvanceTo(1, nanoseconds(0)), std::logic_error);
    EXPECT_THROW(world_.WaitForService(nanoseconds(0)), std::logic_error);
    ++refused;
  });
  Arrive(OwnEvent(1, 1, 1));
  world_.Poll();
  EXPECT_EQ(refused, 1);
  world_.Poll();
}

TEST_F(EventsTest, ACallbackThatThrowsLosesNoOtherEvent) {
  int called = 0;
  world_.OnEvent([&](const Event&) {
    if (++called == 1) throw std::runtime_error("no");
  });
  Arrive(OwnEvent(1, 1, 1));
  Arrive(OwnEvent(1, 2, 2));
  EXPECT_THROW(world_.Poll(), std::runtime_error);
  world_.Poll();
  EXPECT_EQ(called, 2);
}

TEST_F(EventsTest, ACallbackMayReplaceItself) {
  int first = 0, second = 0;
  world_.OnEvent([&](const Event&) {
    ++first;
    world_.OnEvent([&](const Event&) { ++second; });
  });
  Arrive(OwnEvent(1, 1, 1));
  Arrive(OwnEvent(1, 2, 2));
  world_.Poll();
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
}

TEST_F(EventsTest, NoCallbackRunsAfterTheWorldHasEnded) {
  std::optional<World> world = std::move(world_);
  Agent ball = world->AddAgent(Point(), {});
  int called = 0;
  world->OnEvent([&](const Event&) {
    ++called;
    world.reset();
    network_->written.clear();
    EXPECT_NO_THROW(ball.SetState({.position_error_m = -1}));
  });
  Arrive(OwnEvent(1, 1, 1));
  Arrive(OwnEvent(1, 2, 2));
  EXPECT_EQ(world->AdvanceTo(5, hours(1)), Advance::kTimeout);
  EXPECT_EQ(called, 1);
  EXPECT_TRUE(network_->written.empty());
}

TEST_F(EventsTest, WithoutACallbackTheNewestAreKeptUpToABound) {
  for (std::uint32_t i = 1; i <= kEventsMax + 3; ++i) Arrive(OwnEvent(1, i, i));
  world_.Poll();
  EXPECT_EQ(world_.events_lost(), 3u);
  const std::vector<Event> events = world_.TakeEvents();
  ASSERT_EQ(events.size(), kEventsMax);
  EXPECT_EQ(events.front().revision, 4u);
}

}  // namespace
}  // namespace collision::client
