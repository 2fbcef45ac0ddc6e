// Goal:   an owner hears each revision about its hypothetical agents once, whichever service tells
//         it: nothing that one of them repeats, and everything new, also after a repetition.
// Method: messages about one pair, as two services write them.
#include "client/library/network/screening_filter.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

struct Said {
  std::uint64_t service = 1;
  std::uint32_t epoch = 1, contact = 1, revision = 1;
  v1::EventStatus status = v1::EVENT_POSSIBLE;
  std::int64_t begin_ns = 100;
  std::uint32_t slot = 0;
};

class ScreeningFilterTest : public testing::Test {
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
    return filter_.IsNew(event);
  }

  ScreeningFilter filter_;
};

TEST_F(ScreeningFilterTest, OfOneServiceOnlyWhatFollowsIsNew) {
  EXPECT_TRUE(IsNew({.revision = 3}));
  EXPECT_FALSE(IsNew({.revision = 3}));
  EXPECT_FALSE(IsNew({.revision = 2, .begin_ns = 50}));
  EXPECT_TRUE(IsNew({.revision = 4, .begin_ns = 200}));
  EXPECT_TRUE(IsNew({.contact = 2}));
  EXPECT_FALSE(IsNew({.revision = 9})) << "of the contact before";
  EXPECT_TRUE(IsNew({.slot = 1})) << "of another pair";
}

TEST_F(ScreeningFilterTest, WhatAnotherServiceRepeatsIsNotNew) {
  IsNew({.revision = 3});
  EXPECT_FALSE(IsNew({.service = 2, .revision = 7}));
  EXPECT_TRUE(IsNew({.service = 2, .revision = 8})) << "it tells a revision of its own";
}

TEST_F(ScreeningFilterTest, AnEarlierBeginIsNoRepetition) {
  IsNew({.revision = 3});
  EXPECT_TRUE(IsNew({.service = 2, .revision = 1, .begin_ns = 99}));
  EXPECT_FALSE(IsNew({.service = 1, .revision = 4, .begin_ns = 99}));
}

TEST_F(ScreeningFilterTest, AnotherOutcomeOrContactIsNoRepetition) {
  IsNew({});
  EXPECT_TRUE(IsNew({.service = 2, .status = v1::EVENT_DISMISSED}));
  EXPECT_TRUE(IsNew({.service = 3, .contact = 2, .status = v1::EVENT_DISMISSED}));
}

TEST_F(ScreeningFilterTest, InAnotherEpochAllIsNew) {
  IsNew({.revision = 3});
  EXPECT_TRUE(IsNew({.epoch = 2, .revision = 1}));
  EXPECT_TRUE(IsNew({.service = 2, .epoch = 3, .revision = 1}));
}

}  // namespace
}  // namespace collision::client
