// Goal:   a crossing is told again exactly if the pair was certainly far apart between the two,
//         also where that turns out later; a first one always is.
// Method: revisions as two detectors make them, of one pair.
#include "server/detectors/hysteresis.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

using detection::CollisionEvent;
using detection::EventStatus;
using Events = std::vector<CollisionEvent>;

Instant At(std::int64_t seconds) { return Instant::FromNanoseconds(seconds * 1'000'000'000); }

CollisionEvent Of(std::uint32_t contact, EventStatus status) {
  CollisionEvent event;
  event.lower.slot = 1;
  event.higher.slot = 2;
  event.contact = contact;
  event.status = status;
  return event;
}

CollisionEvent Possible(std::uint32_t contact, std::int64_t from) {
  CollisionEvent event = Of(contact, EventStatus::kPossible);
  event.begin.earliest = At(from);
  return event;
}

/// It began in the second before `by`.
CollisionEvent Confirmed(std::uint32_t contact, std::int64_t by) {
  CollisionEvent event = Of(contact, EventStatus::kConfirmed);
  event.begin = {At(by - 1), At(by)};
  return event;
}

CollisionEvent Ended(std::uint32_t contact, std::int64_t begun_by, std::int64_t free_at) {
  CollisionEvent event = Confirmed(contact, begun_by);
  event.status = EventStatus::kEnded;
  event.end = {At(free_at - 1), At(free_at)};
  return event;
}

/// Contact and status of each: "1 confirmed 2 possible".
std::string Text(const Events& events) {
  static constexpr const char* kNames[] = {"possible",  "confirmed", "dismissed",
                                           "undecided", "withdrawn", "ended"};
  std::string text;
  for (const CollisionEvent& event : events) {
    text += (text.empty() ? "" : " ") + std::to_string(event.contact) + " " +
            kNames[static_cast<int>(event.status)];
  }
  return text;
}

class HysteresisTest : public testing::Test {
 protected:
  std::string Take(const Events& near, const Events& far = {}) {
    return Text(hysteresis.Take(near, far));
  }
  Hysteresis hysteresis;
};

TEST_F(HysteresisTest, AFirstCrossingIsToldWhole) {
  EXPECT_EQ(Take({Possible(1, 10)}), "1 possible");
  EXPECT_EQ(Take({Confirmed(1, 10)}), "1 confirmed");
  EXPECT_EQ(Take({Ended(1, 10, 12)}), "1 ended");
  EXPECT_EQ(hysteresis.withheld(), 0u);
}

TEST_F(HysteresisTest, OneThatFollowsTooSoonIsHeldBackWhole) {
  Take({Confirmed(1, 10), Ended(1, 10, 12)});
  EXPECT_EQ(Take({Possible(2, 13)}), "");
  EXPECT_EQ(Take({Confirmed(2, 14)}), "");
  EXPECT_EQ(Take({Ended(2, 14, 15)}), "");
  EXPECT_EQ(Take({Possible(3, 16)}), "");
  EXPECT_EQ(Take({Of(3, EventStatus::kDismissed)}), "");
  EXPECT_EQ(hysteresis.withheld(), 5u);
}

TEST_F(HysteresisTest, AfterTheyWereFarApartTheNextIsTold) {
  Take({Ended(1, 10, 12)});
  EXPECT_EQ(Take({}, {Ended(1, 9, 20)}), "");
  EXPECT_EQ(Take({Possible(2, 21)}), "2 possible");
  EXPECT_EQ(Take({Confirmed(2, 22)}), "2 confirmed");
  EXPECT_EQ(Take({Ended(2, 22, 23), Confirmed(3, 24)}), "2 ended") << "once for each time apart";
}

TEST_F(HysteresisTest, OneThatIsHeldBackIsToldWhenItTurnsOutThatTheyWereFarApart) {
  Take({Ended(1, 10, 12)});
  EXPECT_EQ(Take({Confirmed(2, 25)}), "");
  EXPECT_EQ(Take({}, {Ended(1, 9, 20)}), "2 confirmed");
  EXPECT_EQ(Take({Ended(2, 25, 26)}), "2 ended");
  EXPECT_EQ(hysteresis.withheld(), 0u);
}

TEST_F(HysteresisTest, WithinOneStepTheOrderInTimeCounts) {
  EXPECT_EQ(Take({Ended(1, 10, 12), Confirmed(2, 25)}, {Ended(1, 9, 20), Ended(2, 24, 40)}),
            "1 ended 2 confirmed");
  EXPECT_EQ(Take({Ended(2, 25, 27), Confirmed(3, 30)}), "2 ended") << "40 s is after it";
}

TEST_F(HysteresisTest, BeingFarApartAfterwardsDoesNotCount) {
  Take({Ended(1, 10, 12)});
  EXPECT_EQ(Take({Confirmed(2, 15)}, {Ended(1, 9, 20)}), "");
  EXPECT_EQ(Take({Possible(2, 15)}), "") << "its forecast would never be closed";
  EXPECT_EQ(Take({Confirmed(3, 21)}), "3 confirmed");
}

TEST_F(HysteresisTest, WhatMayHaveBegunBeforeThePairWasKnownIsTold) {
  Take({Ended(1, 10, 12)});
  CollisionEvent jumped = Confirmed(2, 15);
  jumped.began_before = true;
  EXPECT_EQ(Take({jumped}), "2 confirmed");
}

TEST_F(HysteresisTest, PairsDoNotDisturbEachOther) {
  Take({Ended(1, 10, 12)});
  CollisionEvent other = Confirmed(1, 14);
  other.higher.slot = 3;
  EXPECT_EQ(Take({Confirmed(2, 14), other}), "1 confirmed");
}

}  // namespace
}  // namespace collision::server
