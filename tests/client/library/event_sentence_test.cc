// Goal:   one sentence says of every event what is certain and what is not, in the tense of now,
//         with times rounded outward.
// Method: whole sentences are compared.
#include <gtest/gtest.h>

#include "collision/event_text.h"

namespace collision::client {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::string NameOf(const AgentId& id) { return id.slot == 0 ? "ada (people)" : "bob (people)"; }

Event Contact(EventStatus status) {
  Event event;
  event.status = status;
  event.higher.slot = 1;
  event.begin = {2'101'000'000, 2'109'000'000};
  event.proximity.emplace();
  event.proximity->at_ns = 2'109'000'000;
  event.proximity->separation_upper_m = -0.1;
  event.proximity->point_m = {4.2, -0.04, 0};
  event.proximity->point_error_m = 0.3;
  return event;
}

Event Forecast(EventStatus status) {
  Event event;
  event.status = status;
  event.higher.slot = 1;
  event.begin = {4'192'849'000, kNever};
  return event;
}

void Expect(const Event& event, std::int64_t now_ns, const std::string& text) {
  EXPECT_EQ(EventSentence(event, NameOf, now_ns, 0), "ada (people) and bob (people) " + text);
}

TEST(EventSentence, OfAContactAhead) {
  Event event = Contact(EventStatus::kConfirmed);
  event.begin = {2'100'000'000, 2'110'000'000};
  Expect(event, kSecond, "will touch between 2.10 s and 2.11 s, at (4.2, 0.0, 0.0) m.");
  event.end = {3 * kSecond, 3 * kSecond};
  Expect(event, kSecond,
         "will touch between 2.10 s and 2.11 s, at (4.2, 0.0, 0.0) m, and will part at "
         "3.000000000 s.");
}

TEST(EventSentence, OfAContactThatLasts) {
  Event event = Contact(EventStatus::kConfirmed);
  event.end = {kNever, kNever};
  Expect(event, 3 * kSecond, "began to touch between 2.101 s and 2.109 s, at (4.2, 0.0, 0.0) m.");
  event.end = {2'800'000'000, kNever};
  Expect(event, 3 * kSecond,
         "began to touch between 2.101 s and 2.109 s, at (4.2, 0.0, 0.0) m, and still touched at "
         "2.80 s.");
  Expect(event, 2'500'000'000,
         "began to touch between 2.101 s and 2.109 s, at (4.2, 0.0, 0.0) m, and will still touch "
         "at 2.80 s.");
}

TEST(EventSentence, OfAContactThatHasEnded) {
  Event event = Contact(EventStatus::kEnded);
  event.end = {3'249'390'000, 3'250'610'000};
  Expect(event, 9 * kSecond,
         "began to touch between 2.101 s and 2.109 s, at (4.2, 0.0, 0.0) m, and parted between "
         "3.249 s and 3.251 s.");
  event.end = {3'249'390'000, kNever};
  event.because = "silent";
  Expect(event, 9 * kSecond,
         "began to touch between 2.101 s and 2.109 s, at (4.2, 0.0, 0.0) m; when they parted is "
         "not known, since the service removed a simulator that was silent.");
}

TEST(EventSentence, OfAContactThatBeganBeforeTheyWereKnown) {
  Event event = Contact(EventStatus::kConfirmed);
  event.began_before = true;
  event.proximity.reset();
  event.end.earliest_ns = kNever;
  Expect(event, 3 * kSecond, "touched by 2.11 s, perhaps since before one of them was known.");
  event.begin.latest_ns = kNever;
  Expect(event, 3 * kSecond, "touched perhaps since before one of them was known.");
}

TEST(EventSentence, OfAPossibleContact) {
  Event event = Forecast(EventStatus::kPossible);
  Expect(event, kSecond, "could touch, but not before 4.19 s.");
  // It would have been told if that had changed.
  event.now_ns = 3'742'000'000;
  Expect(event, 5 * kSecond, "could touch about 0.45 s ahead, as last told at 3.74 s.");
  event.now_ns = 4'200'000'000;
  Expect(event, 5 * kSecond, "could be touching, as last told at 4.20 s.");
  event.began_before = true;
  Expect(event, 5 * kSecond, "could be touching, perhaps since before one of them was known.");
  event.began_before = false;
  event.begin.earliest_ns = kNever;
  Expect(event, 5 * kSecond, "could touch at a time that is not known.");
}

TEST(EventSentence, OfWhatIsExpected) {
  Event event = Forecast(EventStatus::kPossible);
  event.expected.emplace().until_ns = 9 * kSecond;
  Expect(event, kSecond,
         "could touch, but not before 4.19 s; if both keep their motion, it is open whether they "
         "touch.");
  event.expected->outcome = ExpectedOutcome::kTouch;
  event.expected->begin = {4'500'000'000, 4'510'000'000};
  Expect(event, kSecond,
         "could touch, but not before 4.19 s; if both keep their motion, they touch between 4.50 s "
         "and 4.51 s.");
  event.expected->outcome = ExpectedOutcome::kPass;
  event.expected->closest = {0, 9 * kSecond, {5 * kSecond, 6 * kSecond}, 1.994, 2};
  Expect(event, kSecond,
         "could touch, but not before 4.19 s; if both keep their motion, they stay at least 1.99 m "
         "apart up to 9.00 s.");
}

TEST(EventSentence, OfHowFastAndHowNear) {
  Event event = Contact(EventStatus::kConfirmed);
  event.end = {kNever, kNever};
  event.proximity->relative_velocity = {{3, 0, -4}, 0.1};
  Expect(event, 3 * kSecond,
         "began to touch between 2.101 s and 2.109 s, at (4.2, 0.0, 0.0) m, at 5 m/s.");
  event = Forecast(EventStatus::kDismissed);
  event.closest = {0, 9 * kSecond, {5 * kSecond, 6 * kSecond}, 1.994, 2.001};
  Expect(event, 9 * kSecond,
         "did not touch, which had been possible from 4.19 s; they came as near as 1.99 to 2.01 m, "
         "between 5.00 s and 6.00 s.");
}

TEST(EventSentence, OfOneThatCameToNothing) {
  Event event = Forecast(EventStatus::kDismissed);
  Expect(event, kSecond, "will not touch, which had been possible from 4.19 s.");
  Expect(event, 5 * kSecond, "did not touch, which had been possible from 4.19 s.");
  event.status = EventStatus::kWithdrawn;
  Expect(event, 5 * kSecond, "could have touched from 4.19 s, which is withdrawn.");
  for (const auto& [because, text] : {std::pair("left", "one of them left"),
                                      {"evicted", "an operator evicted a simulator"},
                                      {"restarted", "time began anew"},
                                      {"refused", "the service refused a simulator"}}) {
    event.because = because;
    Expect(event, 5 * kSecond,
           "could have touched from 4.19 s, which is withdrawn, since " + std::string(text) + ".");
  }
}

TEST(EventSentence, OfAnUndecidedOne) {
  Event event = Forecast(EventStatus::kUndecided);
  event.end = {kNever, 4'400'001'000};
  event.limited_by = EventLimit::kMotion;
  Expect(event, 5 * kSecond,
         "may have touched between 4.19 s and 4.41 s: neither contact nor a gap could be "
         "certified, since their motion is not known well enough.");
  event.limited_by = EventLimit::kNone;
  event.began_before = true;
  Expect(event, 5 * kSecond,
         "may have touched, perhaps since before one of them was known, up to 4.41 s: neither "
         "contact nor a gap could be certified.");
  event.began_before = false;
  event.end.latest_ns = kNever;
  Expect(event, 5 * kSecond,
         "may have touched from 4.19 s: neither contact nor a gap could be certified.");
}

TEST(EventSentence, TellsAMarginAndTimesOfDay) {
  Event event = Forecast(EventStatus::kPossible);
  event.margin_m = 2.3;
  event.begin.earliest_ns = 1'795'229'895'022'000'000;
  Expect(event, kSecond,
         "could touch, but not before 02:58:15.02 UTC (within 2.3 m counts as touching).");
  event.level = "near";
  Expect(event, kSecond,
         "could touch, but not before 02:58:15.02 UTC (within 2.3 m counts as touching: level "
         "near).");
}

// A point that is known badly has no digits that say otherwise; an instant is told exactly.
TEST(EventSentence, HasTheDigitsThatAreKnown) {
  Event event = Contact(EventStatus::kConfirmed);
  event.begin = {2'100'000'001, 2'100'000'003};
  event.proximity->point_error_m = 0.002;
  Expect(event, kSecond,
         "will touch between 2.100000001 s and 2.100000003 s, at (4.200, -0.040, "
         "0.000) m.");
  event.proximity->point_error_m = 0;
  Expect(event, kSecond,
         "will touch between 2.100000001 s and 2.100000003 s, at (4.200, -0.040, "
         "0.000) m.");
}

}  // namespace
}  // namespace collision::client
