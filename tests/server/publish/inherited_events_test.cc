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
  return event;
}

v1::CollisionEvent Told(std::uint32_t contact, v1::EventStatus status, std::int64_t begin_ns) {
  v1::CollisionEvent event;
  event.mutable_lower()->set_slot(1);
  event.mutable_higher()->set_slot(2);
  event.set_contact(contact);
  event.set_status(status);
  event.mutable_begin()->set_earliest_ns(begin_ns + 2);
  event.mutable_begin()->set_latest_ns(begin_ns + 8);
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

TEST(InheritedEvents, WhatWasNotToldIs) {
  InheritedEvents events;
  events.Hear(Told(1, v1::EVENT_CONFIRMED, 100));
  events.Keep(Found(1, EventStatus::kEnded, 100));
  events.Keep(Found(2, EventStatus::kConfirmed, 500));
  const std::vector<CollisionEvent> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), 2u);
  EXPECT_EQ(untold[0].status, EventStatus::kEnded);
  EXPECT_EQ(events.NumberOf(untold[0]), 1u);
  EXPECT_EQ(events.NumberOf(untold[1]), 2u);
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
  const std::vector<CollisionEvent> untold = events.TakeUntold();
  ASSERT_EQ(untold.size(), InheritedEvents::kUntoldMax);
  EXPECT_EQ(untold.front().contact, 2u);
}

}  // namespace
}  // namespace collision::server
