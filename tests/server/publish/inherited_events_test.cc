// Goal:   after a take-over no contact is lost, and none is told as another one.
// Method: what the service in force has told, against what the standby would tell, by hand: both
//         count alike, the standby has joined late, it is ahead, it is behind.
#include "server/publish/inherited_events.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

using detection::CollisionEvent;
using detection::EventStatus;

CollisionEvent Found(std::uint32_t contact, EventStatus status, std::int64_t begin_ns) {
  CollisionEvent event;
  event.lower.slot = 1;
  event.higher.slot = 2;
  event.contact = contact;
  event.status = status;
  event.begin = {Instant::FromNanoseconds(begin_ns), Instant::FromNanoseconds(begin_ns + 10)};
  if (status == EventStatus::kEnded) event.end.latest = Instant::FromNanoseconds(begin_ns + 50);
  return event;
}

/// Forecasts have no sequence of contacts.
v1::CollisionEvent Told(std::uint32_t contact, v1::EventStatus status, std::int64_t begin_ns) {
  v1::CollisionEvent event;
  event.mutable_stamp()->set_epoch(1);
  event.mutable_lower()->set_slot(1);
  event.mutable_higher()->set_slot(2);
  event.set_contact(contact);
  event.set_status(status);
  event.mutable_begin()->set_earliest_ns(begin_ns + 2);
  event.mutable_begin()->set_latest_ns(begin_ns + 8);
  const bool over = status == v1::EVENT_ENDED;
  event.mutable_end()->set_latest_ns(over ? begin_ns + 50 : Instant::Never().nanoseconds());
  if (over || status == v1::EVENT_CONFIRMED) event.set_contacts_sequence(1);
  return event;
}

TEST(InheritedEvents, WhatWasToldIsNotInherited) {
  InheritedEvents before, after;
  before.Hear(Told(1, v1::EVENT_CONFIRMED, 100));
  before.Keep(Found(1, EventStatus::kConfirmed, 100));
  after.Keep(Found(1, EventStatus::kConfirmed, 100));
  after.Hear(Told(1, v1::EVENT_CONFIRMED, 100));
  EXPECT_TRUE(before.TakeUntold().empty());
  EXPECT_TRUE(after.TakeUntold().empty());
}

// The other service may have ended before readers had its last words.
TEST(InheritedEvents, TheNewestContactsAreToldOnceMore) {
  InheritedEvents events;
  for (std::uint32_t i = 0; i <= InheritedEvents::kRepeatedMax; ++i) {
    events.Hear(Told(i + 1, v1::EVENT_CONFIRMED, 100 * i));
    events.Hear(Told(i + 1, v1::EVENT_POSSIBLE, 100 * i));
  }
  const std::vector<v1::CollisionEvent> told = events.TakeTold();
  ASSERT_EQ(told.size(), InheritedEvents::kRepeatedMax);
  EXPECT_EQ(told.front().contact(), 2u);
  EXPECT_TRUE(events.TakeTold().empty());
}

TEST(InheritedEvents, WhatWasNotToldIs) {
  InheritedEvents events;
  events.Hear(Told(1, v1::EVENT_CONFIRMED, 100));
  events.Keep(Found(1, EventStatus::kEnded, 100));
  events.Keep(Found(2, EventStatus::kConfirmed, 500));
  const std::vector<UntoldContact> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), 2u);
  EXPECT_EQ(untold[0].event.status, EventStatus::kEnded);
  EXPECT_EQ(events.NumberOf(untold[0].event), 1u);
  EXPECT_EQ(events.NumberOf(untold[1].event), 2u);
  EXPECT_TRUE(events.TakeUntold().empty());
}

TEST(InheritedEvents, OneThatJoinedLateGoesOnWithTheNumbersThatReadersKnow) {
  InheritedEvents same;
  same.Hear(Told(7, v1::EVENT_CONFIRMED, 100));
  EXPECT_EQ(same.NumberOf(Found(1, EventStatus::kEnded, 100)), 7u);
  EXPECT_EQ(same.NumberOf(Found(2, EventStatus::kPossible, 900)), 8u);
  InheritedEvents next;
  next.Hear(Told(7, v1::EVENT_ENDED, 100));
  EXPECT_EQ(next.NumberOf(Found(1, EventStatus::kPossible, 500)), 8u);
}

// One of the two joined while the pair was in contact, and knows no begin; or it has counted a
// forecast that the other one did not have.
TEST(InheritedEvents, WhatIsOneContactIsNotToldTwice) {
  CollisionEvent joined = Found(2, EventStatus::kEnded, 130);
  joined.began_before = true;
  InheritedEvents events;
  events.Hear(Told(1, v1::EVENT_ENDED, 100));
  events.Keep(joined);
  events.Keep(Found(2, EventStatus::kEnded, 100));
  EXPECT_TRUE(events.TakeUntold().empty());
  joined.begin = {Instant::FromNanoseconds(400), Instant::FromNanoseconds(400)};
  joined.end.latest = Instant::FromNanoseconds(500);
  events.Keep(joined);
  EXPECT_EQ(events.TakeUntold().size(), 1u) << "after its end it is another one";
}

// The next one is announced, and hides nothing of the one that is over.
TEST(InheritedEvents, AForecastHidesNoContact) {
  InheritedEvents events;
  events.Hear(Told(1, v1::EVENT_ENDED, 100));
  events.Hear(Told(2, v1::EVENT_POSSIBLE, 500));
  events.Keep(Found(1, EventStatus::kEnded, 100));
  EXPECT_TRUE(events.TakeUntold().empty());
  events.Keep(Found(1, EventStatus::kConfirmed, 600));
  const std::vector<UntoldContact> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), 1u) << "it joined after the first";
  EXPECT_EQ(events.NumberOf(untold[0].event), 2u) << "goes on with the forecast";
  EXPECT_EQ(events.NumberOf(Found(2, EventStatus::kPossible, 900)), 3u);
}

// A standby that joined late knows fewer states.
TEST(InheritedEvents, WhereTheServiceHasFoundFreedomNothingIsUndecidedForReaders) {
  v1::CollisionEvent dismissed = Told(1, v1::EVENT_DISMISSED, 100);
  dismissed.set_now_ns(150);
  for (const v1::CollisionEvent& told : {dismissed, Told(1, v1::EVENT_POSSIBLE, 150)}) {
    InheritedEvents events;
    events.Hear(told);
    CollisionEvent undecided = Found(1, EventStatus::kUndecided, 100);
    undecided.end.latest = Instant::FromNanoseconds(150);
    events.Keep(undecided);
    EXPECT_TRUE(events.TakeUntold().empty());
    undecided.end.latest = Instant::FromNanoseconds(200);
    events.Keep(undecided);
    EXPECT_EQ(events.TakeUntold().size(), 1u);
  }
}

// What has no end yet, and no begin, is over before the next one.
TEST(InheritedEvents, TheNextOneIsToldThoughTheEndWasNot) {
  v1::CollisionEvent told = Told(1, v1::EVENT_CONFIRMED, 100);
  told.set_began_before(true);
  InheritedEvents events;
  events.Hear(told);
  events.Keep(Found(1, EventStatus::kEnded, 90));
  events.Keep(Found(2, EventStatus::kConfirmed, 300));
  EXPECT_EQ(events.TakeUntold().size(), 2u);
}

TEST(InheritedEvents, AContactIsNotTakenForAForecastThatCameToNothing) {
  InheritedEvents events;
  events.Hear(Told(1, v1::EVENT_DISMISSED, 100));
  events.Keep(Found(2, EventStatus::kConfirmed, 100));
  const std::vector<UntoldContact> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), 1u);
  EXPECT_EQ(events.NumberOf(untold[0].event), 2u);
}

TEST(InheritedEvents, AForecastThatCameLateDoesNotReopenAContact) {
  InheritedEvents events;
  events.Hear(Told(3, v1::EVENT_ENDED, 100));
  events.Hear(Told(3, v1::EVENT_POSSIBLE, 90));
  events.Hear(Told(2, v1::EVENT_CONFIRMED, 10));
  events.Keep(Found(3, EventStatus::kEnded, 100));
  EXPECT_TRUE(events.TakeUntold().empty());
}

TEST(InheritedEvents, OfTooManyTheOldestIsGivenUp) {
  InheritedEvents events;
  for (std::uint32_t i = 0; i <= InheritedEvents::kUntoldMax; ++i) {
    events.Keep(Found(i + 1, EventStatus::kConfirmed, i));
  }
  const std::vector<UntoldContact> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), InheritedEvents::kUntoldMax);
  EXPECT_EQ(untold.front().event.contact, 2u);
}

/// Of a pair of its own.
CollisionEvent InSlots(std::uint32_t slot, CollisionEvent event) {
  event.higher.slot = slot;
  return event;
}

// With one walk over all untold contacts for each message this would take minutes.
TEST(InheritedEvents, WhatIsHeardCostsNothingForOtherPairs) {
  constexpr auto kPairs = static_cast<std::uint32_t>(InheritedEvents::kUntoldMax);
  InheritedEvents events;
  for (std::uint32_t slot = 2; slot < 2 + kPairs; ++slot) {
    events.Keep(InSlots(slot, Found(1, EventStatus::kConfirmed, 100)));
  }
  for (std::uint32_t slot = 2 + kPairs; slot-- > 12;) {
    v1::CollisionEvent told = Told(1, v1::EVENT_CONFIRMED, 100);
    told.mutable_higher()->set_slot(slot);
    events.Hear(told);
  }
  const std::vector<UntoldContact> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), 10u);
  for (std::uint32_t i = 0; i < 10; ++i)
    EXPECT_EQ(untold[i].event.higher.slot, 2 + i) << "in their order";
}

// A standby that stood still has missed states, and cannot exclude what the other one could.
TEST(InheritedEvents, WhatIsOverAndWasNeverCertainIsDroppedOnceTheOtherServiceIsBeyondIt) {
  InheritedEvents events;
  const auto undecided = [](std::int64_t begin_ns, std::uint32_t slot) {
    CollisionEvent event = Found(1, EventStatus::kUndecided, begin_ns);
    event.higher.slot = slot;
    event.end.latest = Instant::FromNanoseconds(begin_ns + 50);
    return event;
  };
  events.Keep(undecided(100, 3));
  events.Keep(undecided(151, 4));
  events.Keep(Found(1, EventStatus::kConfirmed, 100));
  events.Keep(Found(2, EventStatus::kEnded, 120));
  events.DropUndecided(Instant::FromNanoseconds(200));
  events.Keep(undecided(90, 5));
  const std::vector<UntoldContact> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), 3u);
  EXPECT_EQ(untold[0].event.higher.slot, 4u);
  EXPECT_EQ(untold[1].event.status, EventStatus::kConfirmed);
  EXPECT_EQ(untold[2].event.status, EventStatus::kEnded);
}

v1::CollisionEvent InEpoch(std::uint32_t epoch, v1::CollisionEvent event) {
  event.mutable_stamp()->set_epoch(epoch);
  return event;
}

// The same scene again has the same times and numbers.
TEST(InheritedEvents, WhatWasToldInAnotherEpochIsNotTold) {
  InheritedEvents events;
  events.Hear(InEpoch(1, Told(1, v1::EVENT_ENDED, 100)));
  events.Keep(Found(2, EventStatus::kConfirmed, 500));
  events.BeginEpoch(2);
  EXPECT_TRUE(events.TakeTold().empty());
  EXPECT_EQ(events.NumberOf(Found(1, EventStatus::kPossible, 90)), 1u);
  events.Hear(InEpoch(1, Told(1, v1::EVENT_ENDED, 100)));  // It was on its way.
  events.Keep(Found(1, EventStatus::kEnded, 100));
  const std::vector<UntoldContact> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), 1u);
  EXPECT_EQ(untold[0].event.contact, 1u);
}

// It may begin its epoch before this service does.
TEST(InheritedEvents, WhatTheServiceInForceToldInItsNextEpochStaysTold) {
  InheritedEvents events;
  events.Hear(InEpoch(1, Told(4, v1::EVENT_ENDED, 100)));
  events.Hear(InEpoch(2, Told(1, v1::EVENT_CONFIRMED, 100)));
  events.BeginEpoch(2);
  events.Keep(Found(1, EventStatus::kConfirmed, 100));
  EXPECT_TRUE(events.TakeUntold().empty());
  ASSERT_EQ(events.TakeTold().size(), 1u);
}

}  // namespace
}  // namespace collision::server
