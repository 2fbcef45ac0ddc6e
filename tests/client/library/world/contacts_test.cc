// Goal:   a grant never overtakes the contacts that it implies, and lost ones are counted; a
//         monitor counts them, too, and believes one service.
// Method: clearances, contacts and statuses on a network under the test's control.
#include <gtest/gtest.h>

#include "client/library/network/clearance_gate.h"
#include "client/library/network/message_monitor.h"
#include "idl/limits.h"
#include "tests/client/fake_receiver.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

v1::CollisionEvent Contact(std::uint64_t sequence, std::uint32_t revision = 1) {
  v1::CollisionEvent event = OwnEvent(1, revision, sequence);
  event.set_contacts_sequence(sequence);
  event.set_status(v1::EVENT_CONFIRMED);
  return event;
}

class ContactsTest : public testing::Test {
 protected:
  void Grant(std::int64_t until_ns, std::uint64_t contacts_sequence) {
    network_->Grant(until_ns);
    network_->arriving.back().mutable_clearance()->set_contacts_sequence(contacts_sequence);
  }
  void Arrive(const v1::CollisionEvent& event) {
    *network_->arriving.emplace_back().mutable_collision_event() = event;
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  World world_ = ConnectTo(network_);
};

TEST_F(ContactsTest, AGrantWaitsForTheContactsBeforeIt) {
  Grant(10, 0);
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 10);
  Grant(50, 2);
  Arrive(Contact(1));
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 10);
  Arrive(Contact(2, 2));
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 50);
  EXPECT_EQ(world_.TakeEvents().size(), 2u);
  EXPECT_EQ(world_.contacts_missed(), 0u);
}

TEST_F(ContactsTest, AContactIsDeliveredBeforeTheClockMovesOn) {
  std::int64_t clock_then = -1;
  world_.OnEvent([&](const Event&) { clock_then = world_.clock_ns(); });
  network_->on_wait = [this](FakeNetwork* network) {
    if (network->waits.size() < 3) return Grant(50, 1);
    Arrive(Contact(1));
  };
  EXPECT_EQ(world_.AdvanceTo(50, hours(1)), Advance::kReached);
  EXPECT_EQ(clock_then, 0);
}

TEST_F(ContactsTest, ContactsOfOthersCountForTheGrantButAreNotDelivered) {
  v1::CollisionEvent others = Contact(1);
  others.mutable_lower()->set_simulator_id(5);
  Arrive(others);
  Grant(50, 1);
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 50);
  EXPECT_TRUE(world_.TakeEvents().empty());
}

/// The forecast that is published under this number: the newest of its pair slot.
v1::CollisionEvent Forecast(std::uint64_t sequence, std::uint32_t revision) {
  v1::CollisionEvent event = OwnEvent(1, revision, sequence);
  event.set_status(v1::EVENT_POSSIBLE);
  return event;
}

TEST_F(ContactsTest, AGrantWaitsForTheForecastsBeforeIt) {
  Grant(50, 0);
  network_->arriving.back().mutable_clearance()->set_forecasts_sequence(7);
  Arrive(Forecast(6, 1));
  world_.Poll();
  EXPECT_NE(world_.granted_until_ns(), 50);
  Arrive(Forecast(8, 2));  // in place of 7
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 50);
}

// A forged status, or a service that is gone as soon as it came.
TEST_F(ContactsTest, AServiceThatIsFollowedAgainGoesOnWhereItWas) {
  Arrive(Contact(1));
  Arrive(Forecast(7, 2));
  world_.Poll();
  network_->Grant(20, 99);
  world_.Poll();
  network_->later += kServiceSilence;
  Grant(50, 1);
  network_->arriving.back().mutable_clearance()->set_forecasts_sequence(7);
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 50) << "all that it says was published has come";
  world_.AdvanceTo(0, nanoseconds(0));
  const std::vector<Event> events = world_.TakeEvents();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].status, EventStatus::kPossible) << "what was not told yet is not forgotten";
  EXPECT_EQ(world_.contacts_missed(), 0u);
}

TEST_F(ContactsTest, AStepIsToldTheNewestForecastOfEachPairWhateverCameBefore) {
  for (const bool overwritten : {false, true}) {
    std::vector<std::uint32_t> revisions;
    world_.OnEvent([&](const Event& event) { revisions.push_back(event.revision); });
    const std::uint32_t newest = overwritten ? 8 : 4;
    const std::int64_t step = overwritten ? 20 : 10;
    network_->on_wait = [&, step, newest](FakeNetwork* network) {
      if (!overwritten) Arrive(Forecast(newest - 1, newest - 1));
      Arrive(Forecast(newest, newest));
      network->Grant(step);
      network->arriving.back().mutable_clearance()->set_forecasts_sequence(newest);
    };
    EXPECT_EQ(world_.AdvanceTo(step, hours(1)), Advance::kReached);
    EXPECT_EQ(revisions, std::vector<std::uint32_t>{newest});
  }
}

TEST_F(ContactsTest, TheCopyAmongTheForecastsThatSaysThatAPairIsInContactReplacesNone) {
  Arrive(Forecast(1, 1));
  v1::CollisionEvent copy = Contact(2, 2);
  copy.set_contacts_sequence(0);
  Arrive(copy);
  Grant(50, 1);
  network_->arriving.back().mutable_clearance()->set_forecasts_sequence(2);
  world_.AdvanceTo(0, nanoseconds(0));
  const std::vector<Event> events = world_.TakeEvents();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].status, EventStatus::kPossible);
}

TEST_F(ContactsTest, AContactIsNotFollowedByAForecastThatItHasReplaced) {
  Arrive(Forecast(1, 1));
  Arrive(Contact(2, 2));
  Grant(50, 2);
  network_->arriving.back().mutable_clearance()->set_forecasts_sequence(1);
  world_.AdvanceTo(0, nanoseconds(0));
  const std::vector<Event> events = world_.TakeEvents();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].revision, 2u);
}

TEST_F(ContactsTest, AGapIsCountedAndHoldsNothingUp) {
  Grant(10, 0);
  Arrive(Contact(4));
  Grant(50, 4);
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 50);
  EXPECT_EQ(world_.contacts_missed(), 3u);
}

TEST_F(ContactsTest, AClearanceOfAFormerServiceDoesNotPassLater) {
  Grant(50, 1);
  world_.Poll();
  network_->Grant(20, 2);  // the service of term 2
  world_.Poll();
  v1::CollisionEvent event = Contact(1);
  event.mutable_stamp()->set_service_id(2);
  event.mutable_stamp()->set_term(2);
  Arrive(event);
  world_.Poll();
  EXPECT_EQ(world_.granted_until_ns(), 20);
}

class MonitorContactsTest : public testing::Test {
 protected:
  void Status(std::uint64_t service, std::uint32_t term, std::uint64_t contacts) {
    v1::ServiceStatus& status = *next_.outputs.emplace_back().mutable_service_status();
    status.mutable_stamp()->set_service_id(service);
    status.mutable_stamp()->set_term(term);
    status.set_phase(v1::PHASE_SERVING);
    v1::Counter& counter = *status.add_counters();
    counter.set_name(std::string(wire::kContactsCounter));
    counter.set_value(contacts);
  }
  void Arrive(const v1::CollisionEvent& event) {
    *next_.outputs.emplace_back().mutable_collision_event() = event;
  }
  void Poll() { monitor_.Poll(nanoseconds(0)); }

  Arrivals next_;
  std::vector<std::uint64_t> events_;
  std::size_t statuses_ = 0;
  MessageMonitor monitor_{
      std::make_unique<FakeReceiver>(&next_),
      {.event = [this](const auto& event) { events_.push_back(event.contacts_sequence()); },
       .status = [this](const auto&) { ++statuses_; }}};
};

TEST_F(MonitorContactsTest, AMonitorThatWasThereCountsAGap) {
  Status(1, 1, 0);
  Arrive(Contact(2));
  Arrive(Contact(5, 2));
  Poll();
  EXPECT_EQ(events_, (std::vector<std::uint64_t>{2, 5}));
  EXPECT_EQ(monitor_.contacts_missed(), 3u);
}

TEST_F(MonitorContactsTest, AMonitorThatJoinsLaterCountsNone) {
  Status(1, 1, 5000);
  Arrive(Contact(3977));
  Arrive(Contact(3978, 2));
  Poll();
  EXPECT_EQ(monitor_.contacts_missed(), 0u);
}

TEST_F(MonitorContactsTest, WhatAnotherServiceSaysIsDropped) {
  Status(1, 2, 0);
  Status(9, 1, 7);
  v1::CollisionEvent event = Contact(1);
  event.mutable_stamp()->set_term(2);
  Arrive(event);
  v1::CollisionEvent other = Contact(1, 7);
  other.mutable_stamp()->set_service_id(9);
  Arrive(other);
  Poll();
  EXPECT_EQ(statuses_, 1u);
  EXPECT_EQ(events_.size(), 1u);
}

TEST_F(MonitorContactsTest, AServiceThatClaimsIsNotInForce) {
  Status(1, 1, 0);
  Status(2, 7, 0);
  next_.outputs.back().mutable_service_status()->set_phase(v1::PHASE_CLAIMING);
  Arrive(Contact(1));
  Poll();
  EXPECT_EQ(statuses_, 1u);
  EXPECT_EQ(events_.size(), 1u);
}

}  // namespace
}  // namespace collision::client
