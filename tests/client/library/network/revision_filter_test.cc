// Goal:   of two topics one stream: every contact, no forecast that a later revision overtook, no
//         copy; bounded memory.
// Method: events of one pair in the orders that two topics allow, and more pairs than fit; messages
//         about hypothetical agents, as two services write them.
#include "client/library/network/revision_filter.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

v1::CollisionEvent Event(std::uint32_t contact, std::uint32_t revision, v1::EventStatus status,
                         std::uint64_t contacts_sequence = 0) {
  v1::CollisionEvent event;
  event.mutable_stamp()->set_service_id(1);
  event.mutable_higher()->set_slot(1);
  event.set_contact(contact);
  event.set_revision(revision);
  event.set_status(status);
  event.set_contacts_sequence(contacts_sequence);
  return event;
}

class RevisionFilterTest : public testing::Test {
 protected:
  bool IsNew(const v1::CollisionEvent& event) { return filter_.IsNew(event, &contacts_); }

  RevisionFilter filter_;
  ContactSequence contacts_;
};

TEST_F(RevisionFilterTest, AnEventIsToldOnceInItsOrder) {
  EXPECT_TRUE(IsNew(Event(1, 1, v1::EVENT_POSSIBLE)));
  EXPECT_FALSE(IsNew(Event(1, 1, v1::EVENT_POSSIBLE)));
  EXPECT_TRUE(IsNew(Event(1, 3, v1::EVENT_POSSIBLE)));
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 1)));
  EXPECT_FALSE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED)));  // the copy among the forecasts
  EXPECT_TRUE(IsNew(Event(1, 5, v1::EVENT_ENDED, 2)));
  EXPECT_TRUE(IsNew(Event(2, 1, v1::EVENT_POSSIBLE)));
  EXPECT_EQ(contacts_.missed(), 0u);
}

TEST_F(RevisionFilterTest, LevelsCountForThemselves) {
  v1::CollisionEvent near = Event(1, 2, v1::EVENT_CONFIRMED, 1);
  near.set_level("near");
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_POSSIBLE)));
  EXPECT_TRUE(IsNew(near));
  EXPECT_TRUE(IsNew(Event(1, 5, v1::EVENT_POSSIBLE)));
  near.set_revision(1);
  near.set_status(v1::EVENT_POSSIBLE);
  near.clear_contacts_sequence();
  EXPECT_FALSE(IsNew(near));
}

TEST_F(RevisionFilterTest, AForecastThatWasOvertakenIsDropped) {
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 1)));
  EXPECT_FALSE(IsNew(Event(1, 3, v1::EVENT_POSSIBLE)));
}

TEST_F(RevisionFilterTest, ACopyWithoutItsContactIsDropped) {
  EXPECT_FALSE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED)));
  EXPECT_FALSE(IsNew(Event(1, 4, v1::EVENT_UNDECIDED)));
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 1)));
}

TEST_F(RevisionFilterTest, AContactCountsThoughTheNextForecastWasFaster) {
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 1)));
  EXPECT_TRUE(IsNew(Event(2, 1, v1::EVENT_POSSIBLE)));
  EXPECT_TRUE(IsNew(Event(1, 5, v1::EVENT_ENDED, 2)));
  EXPECT_FALSE(IsNew(Event(2, 1, v1::EVENT_POSSIBLE)));
  EXPECT_TRUE(IsNew(Event(2, 2, v1::EVENT_DISMISSED)));
}

TEST_F(RevisionFilterTest, AnotherServiceRepeatsWhatIsKnownAndCountsAnew) {
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 7)));
  contacts_.Restart();
  v1::CollisionEvent repeated = Event(1, 4, v1::EVENT_CONFIRMED, 1);
  repeated.mutable_stamp()->set_service_id(2);
  EXPECT_FALSE(IsNew(repeated));
  v1::CollisionEvent anew = Event(1, 1, v1::EVENT_ENDED, 2);
  anew.mutable_stamp()->set_service_id(2);
  EXPECT_TRUE(IsNew(anew));
}

TEST_F(RevisionFilterTest, WhatOneServiceSaysTwiceIsToldOnce) {
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 1)));
  EXPECT_FALSE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 2)));
  EXPECT_TRUE(IsNew(Event(1, 5, v1::EVENT_ENDED, 3)));
}

TEST_F(RevisionFilterTest, WhatIsRepeatedIsKnownThoughTheNextForecastWasFaster) {
  EXPECT_TRUE(IsNew(Event(1, 4, v1::EVENT_CONFIRMED, 1)));
  EXPECT_TRUE(IsNew(Event(2, 1, v1::EVENT_POSSIBLE)));
  EXPECT_TRUE(IsNew(Event(1, 5, v1::EVENT_ENDED, 2)));
  contacts_.Restart();
  v1::CollisionEvent forecast = Event(2, 1, v1::EVENT_POSSIBLE);
  forecast.mutable_stamp()->set_service_id(2);
  EXPECT_FALSE(IsNew(forecast));
  std::uint64_t sequence = 0;
  for (const auto status : {v1::EVENT_CONFIRMED, v1::EVENT_ENDED}) {
    v1::CollisionEvent repeated = Event(1, 5, status, ++sequence);
    repeated.mutable_stamp()->set_service_id(2);
    EXPECT_FALSE(IsNew(repeated)) << status;
  }
  v1::CollisionEvent next = Event(2, 2, v1::EVENT_CONFIRMED, ++sequence);
  next.mutable_stamp()->set_service_id(2);
  next.mutable_begin()->set_earliest_ns(5);
  next.mutable_begin()->set_latest_ns(6);
  EXPECT_TRUE(IsNew(next));
  EXPECT_EQ(filter_.contacts_repeated(), 2u);
}

TEST_F(RevisionFilterTest, TheNewestPairsAreRememberedAndTheOldestForgotten) {
  v1::CollisionEvent event = Event(1, 1, v1::EVENT_POSSIBLE);
  const std::uint32_t last = 2 * RevisionFilter::kPairsMax + 1;
  for (std::uint32_t pair = 1; pair <= last; ++pair) {
    event.mutable_higher()->set_slot(pair);
    EXPECT_TRUE(IsNew(event));
  }
  event.mutable_higher()->set_slot(last - RevisionFilter::kPairsMax);
  EXPECT_FALSE(IsNew(event));
  event.mutable_higher()->set_slot(1);
  EXPECT_TRUE(IsNew(event));
}

v1::CollisionEvent Of(std::uint64_t service, std::uint32_t epoch, v1::CollisionEvent event) {
  event.mutable_stamp()->set_service_id(service);
  event.mutable_stamp()->set_epoch(epoch);
  return event;
}

// The same scene again has the same numbers and times.
TEST_F(RevisionFilterTest, ANewEpochTellsAllAnew) {
  for (const std::uint32_t epoch : {1, 2}) {
    const std::uint64_t first = 2 * epoch - 1;
    EXPECT_TRUE(IsNew(Of(1, epoch, Event(1, 1, v1::EVENT_POSSIBLE))));
    EXPECT_TRUE(IsNew(Of(1, epoch, Event(1, 4, v1::EVENT_CONFIRMED, first))));
    EXPECT_TRUE(IsNew(Of(1, epoch, Event(1, 5, v1::EVENT_ENDED, first + 1))));
    EXPECT_FALSE(IsNew(Of(1, epoch, Event(1, 1, v1::EVENT_POSSIBLE))));
  }
}

TEST_F(RevisionFilterTest, WhatComesLateOfAnEarlierEpochIsHistory) {
  EXPECT_TRUE(IsNew(Of(1, 1, Event(1, 4, v1::EVENT_CONFIRMED, 1))));
  EXPECT_TRUE(IsNew(Of(1, 2, Event(1, 1, v1::EVENT_POSSIBLE)))) << "faster than the contacts";
  EXPECT_TRUE(IsNew(Of(1, 1, Event(1, 5, v1::EVENT_ENDED, 2))));
  EXPECT_FALSE(IsNew(Of(1, 1, Event(1, 5, v1::EVENT_ENDED, 2))));
  EXPECT_FALSE(IsNew(Of(1, 1, Event(2, 1, v1::EVENT_POSSIBLE))));
  EXPECT_FALSE(IsNew(Of(1, 2, Event(1, 1, v1::EVENT_POSSIBLE)))) << "this one is known still";
}

// A standby numbers epochs like the service beside it; one that is started again begins with 1.
TEST_F(RevisionFilterTest, AnotherServiceGoesOnInItsEpochOrBeginsAnother) {
  EXPECT_TRUE(IsNew(Of(1, 3, Event(1, 4, v1::EVENT_CONFIRMED, 1))));
  for (const std::uint64_t service : {2, 3}) {
    contacts_.Restart();
    const std::uint32_t epoch = service == 2 ? 3 : 1;
    EXPECT_FALSE(IsNew(Of(service, epoch, Event(1, 4, v1::EVENT_CONFIRMED, 1)))) << service;
  }
  contacts_.Restart();
  EXPECT_TRUE(IsNew(Of(4, 2, Event(1, 4, v1::EVENT_CONFIRMED, 1))));
}

// An owner hears each revision about its hypothetical agents once, whichever service tells it.
struct Said {
  std::uint64_t service = 1;
  std::uint32_t epoch = 1, contact = 1, revision = 1;
  v1::EventStatus status = v1::EVENT_POSSIBLE;
  std::int64_t begin_ns = 100;
  std::uint32_t slot = 0;
};

class NewestOfPairTest : public testing::Test {
 protected:
  bool IsNew(const Said& said) {
    v1::CollisionEvent event;
    event.mutable_stamp()->set_service_id(said.service);
    event.mutable_stamp()->set_epoch(said.epoch);
    event.mutable_higher()->set_slot(said.slot);
    event.set_contact(said.contact);
    event.set_revision(said.revision);
    event.set_status(said.status);
    event.mutable_begin()->set_earliest_ns(said.begin_ns);
    return filter_.IsNewest(event);
  }

  RevisionFilter filter_;
};

TEST_F(NewestOfPairTest, OfOneServiceOnlyWhatFollowsIsNew) {
  EXPECT_TRUE(IsNew({.revision = 3}));
  EXPECT_FALSE(IsNew({.revision = 3}));
  EXPECT_FALSE(IsNew({.revision = 2, .begin_ns = 50}));
  EXPECT_TRUE(IsNew({.revision = 4, .begin_ns = 200}));
  EXPECT_TRUE(IsNew({.contact = 2}));
  EXPECT_FALSE(IsNew({.revision = 9})) << "of the contact before";
  EXPECT_TRUE(IsNew({.slot = 1})) << "of another pair";
}

TEST_F(NewestOfPairTest, WhatAnotherServiceRepeatsIsNotNew) {
  IsNew({.revision = 3});
  EXPECT_FALSE(IsNew({.service = 2, .revision = 7}));
  EXPECT_TRUE(IsNew({.service = 2, .revision = 8})) << "it tells a revision of its own";
}

TEST_F(NewestOfPairTest, AnEarlierBeginIsNoRepetition) {
  IsNew({.revision = 3});
  EXPECT_TRUE(IsNew({.service = 2, .revision = 1, .begin_ns = 99}));
  EXPECT_FALSE(IsNew({.service = 1, .revision = 4, .begin_ns = 99}));
}

TEST_F(NewestOfPairTest, AnotherOutcomeOrContactIsNoRepetition) {
  IsNew({});
  EXPECT_TRUE(IsNew({.service = 2, .status = v1::EVENT_DISMISSED}));
  EXPECT_TRUE(IsNew({.service = 3, .contact = 2, .status = v1::EVENT_DISMISSED}));
}

TEST_F(NewestOfPairTest, InAnotherEpochAllIsNew) {
  IsNew({.revision = 3});
  EXPECT_TRUE(IsNew({.epoch = 2, .revision = 1}));
  EXPECT_TRUE(IsNew({.service = 2, .epoch = 3, .revision = 1}));
}

}  // namespace
}  // namespace collision::client
