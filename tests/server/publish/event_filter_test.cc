// Goal:   readers are told every contact and what is new of a forecast, at a bounded rate, and
//         nothing is told late for it; what says nothing new is withheld.
// Method: revisions as the detector makes them, with times that are exact in binary.
#include "server/publish/event_filter.h"

#include <gtest/gtest.h>

#include "server/config/config.h"

namespace collision::server {
namespace {

using detection::CollisionEvent;
using detection::EventStatus;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1000 * kMs;

Instant AtMs(std::int64_t ms) { return Instant::FromNanoseconds(ms * kMs); }

v1::Config ConfigWith(std::uint32_t per_second_max) {
  v1::Config config;
  config.set_forecasts_per_second_max(per_second_max);
  config.set_temporal_resolution_s(0.0625);
  return CompleteConfig(config);
}

/// A revision of the event about the pair in a slot.
CollisionEvent Revision(std::uint32_t slot, EventStatus status, std::int64_t now_ms,
                        std::int64_t begin_ms) {
  CollisionEvent event;
  event.lower.slot = slot;
  event.higher.slot = slot + 1;
  event.pair_slot = slot;
  event.status = status;
  event.now = AtMs(now_ms);
  event.begin.earliest = AtMs(begin_ms);
  return event;
}

CollisionEvent Possible(std::uint32_t slot, std::int64_t now_ms, std::int64_t begin_ms) {
  return Revision(slot, EventStatus::kPossible, now_ms, begin_ms);
}

CollisionEvent Confirmed(std::int64_t now_ms, std::int64_t earliest_ms, std::int64_t latest_ms) {
  CollisionEvent event = Revision(1, EventStatus::kConfirmed, now_ms, earliest_ms);
  event.begin.latest = AtMs(latest_ms);
  return event;
}

class EventFilterTest : public testing::Test {
 protected:
  /// The topics and statuses told after a step, such as "forecast possible 1".
  std::vector<std::string> Told(const std::vector<CollisionEvent>& events, std::int64_t now_ms) {
    static constexpr const char* kNames[] = {"possible",  "confirmed", "dismissed",
                                             "undecided", "withdrawn", "ended"};
    std::vector<std::string> told;
    for (const Telling& telling : filter_.Take(events, AtMs(now_ms), now_ms * kMs)) {
      told.push_back(std::string(telling.contact ? "contact " : "forecast ") +
                     kNames[static_cast<int>(telling.event.status)] + " " +
                     std::to_string(telling.event.pair_slot));
    }
    return told;
  }

  using Tellings = std::vector<std::string>;
  EventFilter filter_{ConfigWith(2)};
};

TEST_F(EventFilterTest, AnApproachAsForetoldIsToldOnce) {
  EXPECT_EQ(Told({Possible(1, 0, 1000)}, 0), Tellings{"forecast possible 1"});
  for (std::int64_t now = 100; now < 1000; now += 100) {
    EXPECT_EQ(Told({Possible(1, now, 1000)}, now), Tellings{});
  }
  EXPECT_EQ(filter_.withheld(), 9u);
}

TEST_F(EventFilterTest, ABeginThatRecedesWithTheClockSaysNothingNew) {
  EXPECT_EQ(Told({Possible(1, 0, 500)}, 0), Tellings{"forecast possible 1"});
  for (std::int64_t now = 100; now < 5000; now += 100) {
    EXPECT_EQ(Told({Possible(1, now, now + 500)}, now), Tellings{});
  }
}

TEST_F(EventFilterTest, WhatIsLeftIsToldWhenItDiffersByMoreThanAQuarter) {
  EXPECT_EQ(Told({Possible(1, 0, 800)}, 0), Tellings{"forecast possible 1"});
  // Later: 800 of 1066 is more than three quarters, of 1068 less.
  EXPECT_EQ(Told({Possible(1, 400, 1466)}, 400), Tellings{});
  EXPECT_EQ(Told({Possible(1, 400, 1468)}, 400), Tellings{"forecast possible 1"});
  // Sooner: 802 of 1068 is more than three quarters, 800 is less; the begin has moved in both.
  EXPECT_EQ(Told({Possible(1, 1400, 2202)}, 1400), Tellings{});
  EXPECT_EQ(Told({Possible(1, 1400, 2200)}, 1400), Tellings{"forecast possible 1"});
}

TEST_F(EventFilterTest, ABeginThatHardlyMovesSaysNothingNew) {
  EXPECT_EQ(Told({Possible(1, 0, 1000)}, 0), Tellings{"forecast possible 1"});
  // What is left has halved, as was foretold: a quarter of the 400 until the begin told is 100.
  EXPECT_EQ(Told({Possible(1, 600, 1100)}, 600), Tellings{});
  EXPECT_EQ(Told({Possible(1, 600, 1101)}, 600), Tellings{"forecast possible 1"});
}

TEST_F(EventFilterTest, WhetherTheyAreExpectedToTouchIsNews) {
  CollisionEvent pass = Possible(1, 0, 9000), touch = Possible(1, 10, 9000);
  pass.expected.emplace().outcome = detection::ExpectedOutcome::kPass;
  touch.expected.emplace().outcome = detection::ExpectedOutcome::kTouch;
  EXPECT_EQ(Told({pass}, 0), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({touch}, 10), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({touch}, 2000), Tellings{});
  EXPECT_EQ(Told({pass}, 4000), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({Possible(1, 0, 9000)}, 6000), Tellings{}) << "nor is it expected now";
}

TEST_F(EventFilterTest, AnEarlierBeginIsToldAlways) {
  EXPECT_EQ(Told({Possible(1, 0, 1000)}, 0), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({Possible(1, 1, 999)}, 1), Tellings{"forecast possible 1"});
}

TEST_F(EventFilterTest, AForecastThatWasToldEnds) {
  for (const auto& [status, name] : {std::pair(EventStatus::kDismissed, "forecast dismissed 1"),
                                     std::pair(EventStatus::kWithdrawn, "forecast withdrawn 1")}) {
    EXPECT_EQ(Told({Possible(1, 0, 1000)}, 0), Tellings{"forecast possible 1"});
    EXPECT_EQ(Told({Revision(1, status, 100, 1000)}, 100), Tellings{name});
    filter_.Forget();
  }
}

TEST_F(EventFilterTest, AForecastThatWasNeverToldIsNotTakenBack) {
  EXPECT_EQ(Told({Possible(1, 0, 1000), Revision(1, EventStatus::kWithdrawn, 0, 1000)}, 0),
            Tellings{});
  EXPECT_EQ(filter_.withheld(), 2u);
}

TEST_F(EventFilterTest, AContactLeavesTheForecasts) {
  EXPECT_EQ(Told({Possible(1, 0, 1000)}, 0), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({Confirmed(1100, 1000, 1100)}, 1100),
            (Tellings{"contact confirmed 1", "forecast confirmed 1"}));
  EXPECT_EQ(Told({Revision(1, EventStatus::kEnded, 2000, 1000)}, 2000),
            Tellings{"contact ended 1"});
}

TEST_F(EventFilterTest, AnUndecidedPairIsAContactForReaders) {
  EXPECT_EQ(Told({Possible(1, 0, 1000)}, 0), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({Revision(1, EventStatus::kUndecided, 2000, 1000)}, 2000),
            (Tellings{"contact undecided 1", "forecast undecided 1"}));
}

TEST_F(EventFilterTest, AContactAtOnceWasNoForecast) {
  EXPECT_EQ(Told({Possible(1, 100, 100), Confirmed(100, 0, 100),
                  Revision(1, EventStatus::kEnded, 100, 0)},
                 100),
            (Tellings{"contact confirmed 1", "contact ended 1"}));
}

TEST_F(EventFilterTest, AConfirmedContactIsRevisedWhenItsBracketHalves) {
  EXPECT_EQ(Told({Confirmed(1000, 0, 1000)}, 1000), Tellings{"contact confirmed 1"});
  EXPECT_EQ(Told({Confirmed(1100, 400, 900)}, 1100), Tellings{});
  EXPECT_EQ(Told({Confirmed(1200, 401, 900)}, 1200), Tellings{"contact confirmed 1"});
  EXPECT_EQ(Told({Confirmed(1300, 600, 900)}, 1300), Tellings{});
}

TEST_F(EventFilterTest, AtTheRateTheSoonestGoesFirstAndTheNewestOfAPairWaits) {
  EXPECT_EQ(
      Told({Possible(1, 0, 1900), Possible(2, 0, 1700), Possible(3, 0, 1800), Possible(4, 0, 1600)},
           0),
      (Tellings{"forecast possible 4", "forecast possible 2"}));
  EXPECT_EQ(Told({Possible(1, 250, 1750)}, 250), Tellings{});
  EXPECT_EQ(Told({}, 500), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({}, 900), Tellings{});
  EXPECT_EQ(Told({}, 1000), Tellings{"forecast possible 3"});
  EXPECT_EQ(filter_.withheld(), 1u);
}

TEST_F(EventFilterTest, ASecondAtRestAllowsNoMoreThanASecondsRate) {
  EXPECT_EQ(Told({}, 0), Tellings{});
  EXPECT_EQ(Told({Possible(1, 9000, 9500), Possible(2, 9000, 9500), Possible(3, 9000, 9500)}, 9000)
                .size(),
            2u);
}

TEST_F(EventFilterTest, WhatMayBeginWithinATemporalResolutionDoesNotWait) {
  EXPECT_EQ(
      Told({Possible(1, 0, 62), Possible(2, 0, 62), Possible(3, 0, 62), Possible(4, 0, 63)}, 0),
      (Tellings{"forecast possible 1", "forecast possible 2", "forecast possible 3"}));
  EXPECT_EQ(Told({}, 1), Tellings{"forecast possible 4"});
}

TEST_F(EventFilterTest, ContactsAndEndsNeverWait) {
  EXPECT_EQ(Told({Possible(1, 0, 500), Possible(2, 0, 500), Possible(3, 0, 500)}, 0).size(), 2u);
  EXPECT_EQ(Told({Confirmed(1, 0, 1), Revision(2, EventStatus::kDismissed, 1, 500),
                  Revision(7, EventStatus::kUndecided, 1, 0)},
                 1),
            (Tellings{"contact confirmed 1", "forecast confirmed 1", "forecast dismissed 2",
                      "contact undecided 7"}));
}

TEST_F(EventFilterTest, AnotherPairInASlotIsAnotherForecast) {
  EXPECT_EQ(Told({Possible(1, 0, 1000)}, 0), Tellings{"forecast possible 1"});
  CollisionEvent other = Possible(1, 1, 1000);
  other.contact = 2;
  EXPECT_EQ(Told({other}, 1), Tellings{"forecast possible 1"});
}

TEST_F(EventFilterTest, WithNoTimeBeforeItNothingOverflows) {
  CollisionEvent unknown = Confirmed(1000, 0, 1000);
  unknown.begin.earliest = Instant::Always();
  EXPECT_EQ(Told({unknown}, 1000), Tellings{"contact confirmed 1"});
  EXPECT_EQ(Told({Confirmed(1100, 0, 1000)}, 1100), Tellings{"contact confirmed 1"});
  filter_.Forget();
  CollisionEvent possible = Possible(1, 0, 0);
  possible.begin.earliest = Instant::Always();
  EXPECT_EQ(Told({possible}, 0), Tellings{"forecast possible 1"});
  EXPECT_EQ(Told({Possible(1, 100, 1000)}, 100), Tellings{"forecast possible 1"});
}

}  // namespace
}  // namespace collision::server
