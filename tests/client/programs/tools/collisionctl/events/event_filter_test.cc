// Goal:   each filter takes what it says and nothing else; together all must hold, and so they do
//         for events that arrive one by one.
// Method: events by hand, in a view whose time is 12.3 s.
#include "client/programs/tools/collisionctl/events/event_filter.h"

#include <gtest/gtest.h>

#include "tests/client/fake_transport.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

constexpr std::int64_t kNow = 12'345'678'901;  // of Status()
constexpr std::int64_t kSecond = 1'000'000'000;

class EventFilterTest : public CollisionctlTest {
 protected:
  void SetUp() override {
    v1::ServiceStamp* stamp = Status()->mutable_stamp();
    stamp->set_service_id(1);
    stamp->set_epoch(2);
    Poll(1);
  }

  /// An event between ada of people and bob of robots that begins so far from now.
  v1::CollisionEvent Make(std::uint32_t contact, std::int64_t ahead_ns) {
    v1::CollisionEvent event = OwnEvent(contact, 1, contact);
    event.mutable_stamp()->set_epoch(2);
    event.set_now_ns(kNow);
    event.mutable_begin()->set_earliest_ns(kNow + ahead_ns);
    event.mutable_begin()->set_latest_ns(kNever);
    event.mutable_end()->set_earliest_ns(kNever);
    event.mutable_end()->set_latest_ns(kNever);
    event.mutable_lower_label()->set_simulator_name("people");
    event.mutable_lower_label()->set_agent_name("ada");
    event.mutable_higher_label()->set_simulator_name("robots");
    event.mutable_higher_label()->set_agent_name("bob");
    return event;
  }

  /// The contacts of those that fit, in their order.
  std::vector<std::uint32_t> Of(const EventFilter& filter,
                                const std::vector<v1::CollisionEvent>& events) {
    const MessageMonitor::Callbacks callbacks = view_.Callbacks();
    for (const auto& event : events) callbacks.event(event);
    std::vector<std::uint32_t> contacts;
    for (const auto& event : EventSelection(filter).Of(view_.TakeEvents(), view_)) {
      contacts.push_back(event.contact());
    }
    return contacts;
  }

  using Contacts = std::vector<std::uint32_t>;
};

TEST_F(EventFilterTest, WithoutAnyAllAreTakenInTheirOrder) {
  EXPECT_EQ(Of({}, {Make(1, 5), Make(2, 3)}), (Contacts{1, 2}));
}

TEST_F(EventFilterTest, ExpectedOnesComeFirstAndAloneIfAsked) {
  v1::CollisionEvent pass = Make(1, 5), touch = Make(2, 9), contact = Make(3, 7), over = Make(4, 1);
  pass.mutable_expected()->set_outcome(v1::EXPECTED_PASS);
  touch.mutable_expected()->set_outcome(v1::EXPECTED_TOUCH);
  contact.set_status(v1::EVENT_CONFIRMED);
  over.set_status(v1::EVENT_DISMISSED);
  EXPECT_EQ(Of({}, {pass, touch, over, contact}), (Contacts{2, 3, 1, 4}));
  EXPECT_EQ(Of({.top = 3}, {pass, touch, over, contact}), (Contacts{3, 2, 4}));
  EXPECT_EQ(Of({.expected = true}, {pass, touch, over, contact}), (Contacts{2, 3, 4}))
      << "what has come to nothing is not possible any more";
}

TEST_F(EventFilterTest, AnAgentIsOnEitherSideWithOrWithoutItsSimulator) {
  std::uint32_t contact = 0;
  for (const char* name : {"ada", "people:ada", "bob", "robots:bob"}) {
    ++contact;
    EXPECT_EQ(Of({.agents = {name}}, {Make(contact, 0)}), Contacts{contact}) << name;
  }
  for (const char* name : {"people", "robots:ada", "people:", "ad", "people:ada2"}) {
    EXPECT_EQ(Of({.agents = {name}}, {Make(++contact, 0)}), Contacts{}) << name;
  }
  EXPECT_EQ(Of({.agents = {"carl", "bob"}}, {Make(7, 0)}), Contacts{7});
}

TEST_F(EventFilterTest, AStatusIsOneOfThoseThatAreNamed) {
  v1::CollisionEvent confirmed = Make(1, 0), ended = Make(2, 0), possible = Make(3, 0);
  confirmed.set_status(v1::EVENT_CONFIRMED);
  ended.set_status(v1::EVENT_ENDED);
  const EventFilter filter{.statuses = {*StatusOf("ended"), *StatusOf("possible")}};
  EXPECT_EQ(Of(filter, {confirmed, ended, possible}), (Contacts{2, 3}));
  EXPECT_EQ(StatusOf("EVENT_ENDED"), std::nullopt);
  EXPECT_EQ(StatusOf(""), std::nullopt);
}

TEST_F(EventFilterTest, ALevelIsOneOfThoseThatAreNamed) {
  v1::CollisionEvent near = Make(1, 0), far = Make(2, 0);
  near.set_level("near");
  far.set_level("far");
  const std::vector<v1::CollisionEvent> events = {near, far, Make(3, 0)};
  EXPECT_EQ(Of({}, events), (Contacts{1, 2, 3}));
  EXPECT_EQ(Of({.levels = {"near", kContactLevel}}, events), (Contacts{1, 3}));
  EXPECT_EQ(Of({.levels = {"nearer"}}, events), Contacts{});
}

TEST_F(EventFilterTest, WithinTakesWhatBeginsByThen) {
  v1::CollisionEvent began_before = Make(4, 9 * kSecond), never = Make(5, 0);
  began_before.set_began_before(true);
  never.mutable_begin()->set_earliest_ns(kNever);
  EXPECT_EQ(Of({.within_ns = 2 * kSecond}, {Make(1, 2 * kSecond), Make(2, 2 * kSecond + 1),
                                            Make(3, -50 * kSecond), began_before, never}),
            (Contacts{1, 3, 4}));
}

// It would have been told anew if that had changed.
TEST_F(EventFilterTest, AForecastWhoseBeginHasComeIsAsFarAheadAsItWas) {
  v1::CollisionEvent event = Make(1, -kSecond);
  event.set_now_ns(kNow - 4 * kSecond);
  EXPECT_EQ(LeadTime(event, kNow), 3 * kSecond);
  EXPECT_EQ(Of({.within_ns = 2 * kSecond}, {event}), Contacts{});
  event.set_now_ns(kNow - kSecond / 2);
  EXPECT_EQ(LeadTime(event, kNow), 0);
  event.set_now_ns(kNow - 4 * kSecond);
  event.set_status(v1::EVENT_CONFIRMED);
  EXPECT_EQ(LeadTime(event, kNow), 0);
}

TEST_F(EventFilterTest, SinceTakesRevisionsThatAreNoOlder) {
  v1::CollisionEvent old = Make(1, 0), older = Make(2, 0), newer = Make(3, 0);
  old.set_now_ns(kNow - kSecond);
  older.set_now_ns(kNow - kSecond - 1);
  newer.set_now_ns(kNow + kSecond);
  EXPECT_EQ(Of({.since_ns = kSecond}, {old, older, newer}), (Contacts{1, 3}));
}

// The times of an earlier epoch are not those of now.
TEST_F(EventFilterTest, WhatIsOfAnEarlierEpochIsNeitherNewNorNear) {
  v1::CollisionEvent past = Make(1, kSecond);
  past.mutable_stamp()->set_epoch(1);
  past.set_now_ns(kNow + 100 * kSecond);
  EXPECT_EQ(NowOf(past, view_), kNow + 100 * kSecond);
  EXPECT_EQ(Of({.since_ns = kSecond}, {past}), Contacts{});
  EXPECT_EQ(Of({.within_ns = 200 * kSecond}, {past}), Contacts{});
  EXPECT_EQ(Of({.top = 1}, {past, Make(4, 50 * kSecond)}), Contacts{4});
}

TEST_F(EventFilterTest, TopTakesTheNearestInTimeNearestFirst) {
  v1::CollisionEvent over = Make(3, -9 * kSecond), lasts = Make(5, -20 * kSecond);
  over.mutable_end()->set_latest_ns(kNow - kSecond);
  const std::vector<v1::CollisionEvent> events = {Make(1, 7 * kSecond), Make(2, 3 * kSecond), over,
                                                  Make(4, 2 * kSecond), lasts};
  EXPECT_EQ(Of({.top = 4}, events), (Contacts{5, 3, 4, 2}));
}

TEST_F(EventFilterTest, FiltersCombineBeforeTopCounts) {
  v1::CollisionEvent confirmed = Make(1, 5 * kSecond);
  confirmed.set_status(v1::EVENT_CONFIRMED);
  EXPECT_EQ(Of({.agents = {"ada"}, .statuses = {EventStatus::kConfirmed}, .top = 1},
               {Make(2, kSecond), confirmed}),
            Contacts{1});
}

TEST_F(EventFilterTest, OneByOneTopTakesWhatIsNearestOfAllSoFar) {
  EventSelection selection({.statuses = {EventStatus::kPossible}, .top = 2});
  EXPECT_TRUE(selection.Takes(Make(1, 5 * kSecond), view_));
  EXPECT_TRUE(selection.Takes(Make(2, 3 * kSecond), view_));
  EXPECT_FALSE(selection.Takes(Make(3, 6 * kSecond), view_));
  EXPECT_TRUE(selection.Takes(Make(4, kSecond), view_));
  EXPECT_FALSE(selection.Takes(Make(1, 5 * kSecond), view_)) << "a revision of the third nearest";
  v1::CollisionEvent dismissed = Make(4, kSecond);
  dismissed.set_status(v1::EVENT_DISMISSED);
  EXPECT_FALSE(selection.Takes(dismissed, view_));
  EXPECT_TRUE(selection.Takes(Make(1, 5 * kSecond), view_)) << "one of the nearer is gone";
}

TEST_F(EventFilterTest, OneByOneTheFarthestBeyondTheLimitIsForgotten) {
  constexpr std::uint32_t kMax = EventSelection::kRememberedMax;
  EventSelection selection({.top = kMax});
  for (std::uint32_t i = 1; i <= kMax; ++i) {
    ASSERT_TRUE(selection.Takes(Make(i, i * kSecond), view_)) << i;
  }
  EXPECT_FALSE(selection.Takes(Make(kMax + 1, (kMax + 1) * kSecond), view_));
  EXPECT_TRUE(selection.Takes(Make(kMax + 2, 0), view_));
  EXPECT_FALSE(selection.Takes(Make(kMax, kMax * kSecond), view_)) << "it was pushed out";
}

TEST(DistanceInTime, IsKeptWithinItsRange) {
  v1::CollisionEvent event;
  event.mutable_begin()->set_earliest_ns(kNever - 1);
  event.mutable_end()->set_latest_ns(kNever);
  EXPECT_EQ(DistanceInTime(event, std::numeric_limits<std::int64_t>::min()), kNever);
  event.mutable_begin()->set_earliest_ns(kNever);
  EXPECT_EQ(DistanceInTime(event, 0), kNever);
  event.set_began_before(true);
  EXPECT_EQ(DistanceInTime(event, 0), 0);
}

// Goal:   a level that the service does not have is an error that lists those it has; while it has
//         not said, none is refused.
TEST_F(EventFilterTest, AnUnknownLevelIsNamedWithThoseThereAre) {
  const EventFilter filter{.levels = {"contact", "near", "nope"}};
  EXPECT_EQ(UnknownLevelText(filter, view_), "");
  v1::ServiceHello hello;
  hello.set_service_id(1);
  v1::KeyValue* levels = hello.add_extensions();
  levels->set_key("levels");
  levels->set_value("near keep-out");
  view_.Callbacks().hello(hello);
  EXPECT_EQ(UnknownLevelText(filter, view_),
            "--level: \"nope\", allowed: contact, near, keep-out, the levels of this service");
  EXPECT_EQ(UnknownLevelText({.levels = {"contact", "near"}}, view_), "");
  EXPECT_EQ(UnknownLevelText({}, view_), "");
}

// Goal:   agents that are not there are named, by either form of their names.
TEST_F(EventFilterTest, AbsentAgentsAreNamed) {
  Describe("ada", 1, 0);
  Poll(1);
  EXPECT_EQ(AbsentAgentsText({.agents = {"ada", "sim:ada"}}, view_), "");
  EXPECT_EQ(AbsentAgentsText({}, view_), "");
  EXPECT_EQ(AbsentAgentsText({.agents = {"bob", "ada", "people:ada"}}, view_),
            "--agent: no agent called \"bob\", \"people:ada\" is here yet; events are shown when "
            "one comes, and collisionctl agents lists those that are here");
}

}  // namespace
}  // namespace collision::client
