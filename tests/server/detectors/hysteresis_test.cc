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

// Goal:   certainly: at the latest end of a time together in the second detector, not before.
TEST_F(HysteresisTest, TheyAreFarApartFromTheLatestEndOn) {
  for (const auto& [begun_by, told] : {std::pair(19, ""), {20, "2 confirmed"}}) {
    hysteresis = {};
    Take({Ended(1, 10, 12)});
    Take({}, {Ended(1, 9, 20)});
    EXPECT_EQ(Take({Confirmed(2, begun_by)}), told);
  }
}

// Goal:   what was never certain ends in certain freedom, too.
TEST_F(HysteresisTest, AnUndecidedTimeTogetherEndsFarApart) {
  CollisionEvent undecided = Of(1, EventStatus::kUndecided);
  undecided.begin.earliest = At(13);
  undecided.end.latest = At(20);
  Take({Ended(1, 10, 12)});
  EXPECT_EQ(Take({}, {undecided}), "");
  EXPECT_EQ(Take({Confirmed(2, 25)}), "2 confirmed");
}

// Goal:   a crossing that may have begun after they were far apart is told.
TEST_F(HysteresisTest, AnUndecidedCrossingCountsByItsLatestBegin) {
  CollisionEvent undecided = Of(2, EventStatus::kUndecided);
  undecided.begin.earliest = At(13);
  for (const auto& [latest, told] : {std::pair(19, ""), {21, "2 undecided"}}) {
    hysteresis = {};
    undecided.end.latest = At(latest);
    Take({Ended(1, 10, 12)});
    Take({}, {Ended(1, 9, 20)});
    EXPECT_EQ(Take({undecided}), told);
  }
}

// Goal:   to have been far apart before the crossing that was told says nothing of the next one.
TEST_F(HysteresisTest, BeingFarApartBeforeTheOneToldDoesNotCount) {
  for (const auto& [free_at, told] : {std::pair(20, ""), {29, ""}, {30, ""}, {31, "2 confirmed"}}) {
    hysteresis = {};
    Take({Confirmed(1, 30)});
    Take({}, {Ended(1, 9, free_at)});
    EXPECT_EQ(Take({Confirmed(2, 40)}), told) << free_at;
  }
}

TEST_F(HysteresisTest, AForecastThatWasHeldBackAndCameToNothingIsNotTold) {
  for (const EventStatus nothing : {EventStatus::kDismissed, EventStatus::kWithdrawn}) {
    hysteresis = {};
    Take({Ended(1, 10, 12)});
    Take({Possible(2, 25)});
    Take({Of(2, nothing)});
    EXPECT_EQ(Take({}, {Ended(1, 9, 20)}), "");
    EXPECT_EQ(hysteresis.withheld(), 2u);
  }
}

TEST_F(HysteresisTest, WhatIsHeldBackWhenTheNextIsToldCountsAsWithheld) {
  Take({Ended(1, 10, 12)});
  Take({Confirmed(2, 14)});
  EXPECT_EQ(Take({Confirmed(3, 30)}, {Ended(1, 9, 20)}), "3 confirmed");
  EXPECT_EQ(hysteresis.withheld(), 1u);
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
