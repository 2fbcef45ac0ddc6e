// Goal:   a line contains what the event contains, rounded outward, in columns.
// Method: whole lines are compared; instants at the ends of their range.
#include "collision/event_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace collision::client {
namespace {

std::string NameOf(const AgentId& id) { return id.slot == 0 ? "iridium-33" : "cosmos-2251"; }

Event Confirmed() {
  Event event;
  event.now_ns = 599'734'999'999;
  event.higher.slot = 1;
  event.contact = 1;
  event.revision = 3;
  event.status = EventStatus::kConfirmed;
  event.begin.earliest_ns = 599'734'236'999;
  event.begin.latest_ns = 599'734'369'001;
  event.end.earliest_ns = 599'734'369'001;
  event.end.latest_ns = kNever;
  event.proximity.emplace();
  event.proximity->at_ns = 599'734'370'000;
  event.proximity->separation_lower_m = -3;
  event.proximity->separation_upper_m = -0.1234;
  return event;
}

TEST(EventText, AConfirmedEvent) {
  EXPECT_EQ(EventLine(Confirmed(), NameOf, 0),
            "    599.734 s  confirmed  iridium-33 × cosmos-2251      #1 r3  "
            "begin [599.734236, 599.734370]  end open  gap ≤ -0.123 m");
}

TEST(EventText, APossibleEventWithOpenBeginOnAWallClock) {
  Event event = Confirmed();
  event.status = EventStatus::kPossible;
  event.begin.latest_ns = kNever;
  event.proximity->separation_lower_m = 0.012345;
  event.proximity->separation_upper_m = 1234.5;
  EXPECT_EQ(EventLine(event, NameOf, 599'000'000'000),
            "      0.734 s  possible   iridium-33 × cosmos-2251      #1 r3  "
            "begin [0.734236, open]  end open  gap [0.0123, 1.24e+03] m");
}

Event OfShapes() {
  Event event = Confirmed();
  event.proximity->depth_lower_m = 0.2345;
  event.proximity->point_m[0] = 1.25;
  event.proximity->point_m[1] = -1234.56789;
  event.proximity->point_m[2] = -0.0;
  event.proximity->point_error_m = 0.16;
  event.proximity->normal.emplace();
  event.proximity->normal->direction[0] = 0.6;
  event.proximity->normal->direction[1] = -0.8;
  event.proximity->normal->error_rad = 0.0873;
  event.tree_level = 6;
  event.work_units = 1840;
  event.limited_by = EventLimit::kBudget;
  return event;
}

std::string FromGap(const Event& event) {
  const std::string line = EventLine(event, NameOf, 0);
  return line.substr(line.find("  gap"));
}

// The rounding of the digits adds to the error: 0.87 of a hundredth of a metre, 0.05 degrees.
TEST(EventText, AContactOfShapesHasPlaceDepthAndLimit) {
  EXPECT_EQ(FromGap(OfShapes()),
            "  gap [-3, -0.123] m  depth ≥ 0.234 m  at (1.25, -1234.57, 0.00) ± 0.169 m  "
            "normal (0.600, -0.800, 0.000) ± 5.06°  tree level 6, 1840 units, limited by budget");
}

TEST(EventText, AContactOfShapesLeavesOutWhatIsUnknown) {
  Event event = OfShapes();
  event.proximity->normal.reset();
  event.proximity->depth_lower_m = 0;
  event.proximity->point_error_m = 0;
  event.limited_by = EventLimit::kNone;
  EXPECT_EQ(FromGap(event),
            "  gap [-3, -0.123] m  at (1.250000000, -1234.567890000, 0.000000000) ± 8.67e-10 m  "
            "tree level 6, 1840 units");
  event.proximity->point_error_m = 1e6;
  EXPECT_NE(FromGap(event).find("  at (1, -1235, 0) ± 1.01e+06 m"), std::string::npos)
      << FromGap(event);
  event.proximity->separation_upper_m = 0.5;
  event.limited_by = EventLimit::kGeometry;
  EXPECT_EQ(FromGap(event), "  gap [-3, 0.5] m  tree level 6, 1840 units, limited by geometry");
  event.limited_by = EventLimit::kMotion;
  EXPECT_NE(FromGap(event).find(", limited by motion"), std::string::npos);
}

TEST(EventText, AContactNamesItsPartsAndItsSpeed) {
  Event event = OfShapes();
  event.proximity->higher_part = 17;
  event.proximity->relative_velocity = {{3, 0, -4}, 0.25};
  const std::string line = FromGap(event);
  EXPECT_NE(line.find("  parts ball × 17  tree level 6"), std::string::npos) << line;
  EXPECT_TRUE(line.ends_with("  relative speed [4.75, 5.25] m/s")) << line;
}

TEST(EventText, APossibleEventSaysWhatIsExpected) {
  Event event = Confirmed();
  event.proximity.reset();
  event.status = EventStatus::kPossible;
  event.expected.emplace();
  const auto expected = [&event] {
    const std::string line = EventLine(event, NameOf, 0);
    return line.substr(line.find("  end open") + 10);
  };
  EXPECT_EQ(expected(), "  expected: undecided");
  event.expected->outcome = ExpectedOutcome::kTouch;
  event.expected->begin = {600'000'000'000, 600'000'000'001};
  EXPECT_EQ(expected(), "  expected to touch in [600.000000, 600.000001]");
  event.expected->outcome = ExpectedOutcome::kPass;
  event.expected->closest = {0, 0, {601'000'000'000, 602'000'000'000}, 1.2345, 1.5};
  EXPECT_EQ(expected(), "  expected to pass at [1.23, 1.5] m in [601.000000, 602.000000]");
}

TEST(EventText, ADismissedEventSaysHowNearTheyCame) {
  Event event = Confirmed();
  event.proximity.reset();
  event.closest = {0, 0, {601'000'000'000, 602'000'000'000}, 1.2345, 1.5};
  EXPECT_EQ(EventLine(event, NameOf, 0).find("passed"), std::string::npos);
  event.status = EventStatus::kDismissed;
  EXPECT_TRUE(EventLine(event, NameOf, 0)
                  .ends_with("  passed at [1.23, 1.5] m in [601.000000, 602.000000]"));
}

TEST(EventText, AnEventOfALevelNamesIt) {
  Event event = Confirmed();
  event.level = "near";
  const std::string line = EventLine(event, NameOf, 0);
  EXPECT_NE(line.find("  #1 r3  level near  begin ["), std::string::npos) << line;
}

TEST(EventText, AnEventThatTheServiceEndedSaysWhy) {
  Event event = OfShapes();
  event.because = "silent";
  EXPECT_TRUE(FromGap(event).ends_with(", limited by budget  because silent")) << FromGap(event);
}

// The surface of a ball is known: there is nothing to search.
TEST(EventText, BallsHaveNoLevel) {
  Event event = OfShapes();
  event.tree_level = 0;
  EXPECT_EQ(FromGap(event), "  gap ≤ -0.123 m");
}

// A contact that may be older than the pair has no time before which they certainly did not touch.
TEST(EventText, AContactThatBeganBeforeHasNoEarliestBegin) {
  Event event = Confirmed();
  event.began_before = true;
  event.proximity.reset();
  std::string line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("  begin")), "  begin ≤ 599.734370 (began before)  end open");
  event.begin.latest_ns = kNever;
  line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("  begin")), "  begin open (began before)  end open");
}

// An undecided pair may not have touched at all.
TEST(EventText, AnUndecidedEventHasNeitherBeginNorEnd) {
  Event event = Confirmed();
  event.status = EventStatus::kUndecided;
  event.end.latest_ns = 599'857'266'001;
  event.proximity->separation_lower_m = -0.5;
  event.proximity->separation_upper_m = 0.5;
  EXPECT_EQ(EventLine(event, NameOf, 0),
            "    599.734 s  undecided  iridium-33 × cosmos-2251      #1 r3  "
            "not certified free in [599.734236, 599.857267]  gap [-0.5, 0.5] m");
  event.began_before = true;
  event.end.latest_ns = kNever;
  const std::string line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("  not")),
            "  not certified free in [599.734236, open] (began before)  gap [-0.5, 0.5] m");
}

TEST(EventText, AWallClockReadsAsTheTimeOfDay) {
  constexpr std::int64_t kStamp = 1'795'229'895'022'000'001;
  EXPECT_EQ(InstantText(kStamp, 0, 3), "02:58:15.022 UTC");
  EXPECT_EQ(TimeText(kStamp, 0, 6, Rounding::kUp), "02:58:15.022001");
  EXPECT_EQ(InstantText(kStamp, kStamp - 1'000'000'000, 3), "1.000 s");
  EXPECT_EQ(TimeText(1'795'305'599'999'999'999, 0, 3, Rounding::kUp), "00:00:00.000");
  EXPECT_EQ(InstantText(100'000'000'000'000'000, 0, 0), "100000000 s");
  EXPECT_EQ(InstantText(kNever, 0, 3), "never");
  Event event = Confirmed();
  event.now_ns = kStamp;
  event.begin.earliest_ns = kStamp;
  EXPECT_EQ(EventLine(event, NameOf, 0).substr(0, 29), "02:58:15.022 UTC  confirmed  ");
}

TEST(EventText, AGapOfZeroHasNoSign) {
  Event event = Confirmed();
  event.proximity->separation_upper_m = -0.0;
  const std::string line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("gap")), "gap ≤ 0 m");
}

TEST(EventText, AnEndShowsWhatIsKnown) {
  Event event = Confirmed();
  event.proximity.reset();
  event.end.earliest_ns = 599'734'400'000;
  EXPECT_NE(EventLine(event, NameOf, 0).find("  end ≥ 599.734400"), std::string::npos);
  event.end.latest_ns = 599'857'266'001;
  const std::string line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("  end")), "  end [599.734400, 599.857267]");
}

TEST(EventText, SecondsRoundAsAskedAtAnyInstant) {
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(SecondsText(1'999'999'999, 0, 3, Rounding::kDown), "1.999");
  EXPECT_EQ(SecondsText(1'999'000'001, 0, 3, Rounding::kUp), "2.000");
  EXPECT_EQ(SecondsText(1'999'000'000, 0, 3, Rounding::kUp), "1.999");
  EXPECT_EQ(SecondsText(-1, 0, 3, Rounding::kDown), "-0.001");
  EXPECT_EQ(SecondsText(-1, 0, 3, Rounding::kUp), "0.000");
  EXPECT_EQ(SecondsText(1'500'000'000, 0, 0, Rounding::kUp), "2");
  EXPECT_EQ(SecondsText(5, 0, 9), "0.000000005");
  EXPECT_EQ(SecondsText(kNever, 5, 3), "never");
  EXPECT_EQ(SecondsText(kNever - 1, kLeast, 9), "18446744073.709551614");
  EXPECT_EQ(SecondsText(kLeast, kNever, 9), "-18446744073.709551615");
}

TEST(EventText, PaddingCountsCharacters) {
  EXPECT_EQ(Padded("a×b", 5), "a×b  ");
  EXPECT_EQ(Padded("long", 2), "long");
}

TEST(EventText, EveryStatusHasAName) {
  EXPECT_STREQ(Name(EventStatus::kPossible), "possible");
  EXPECT_STREQ(Name(EventStatus::kConfirmed), "confirmed");
  EXPECT_STREQ(Name(EventStatus::kDismissed), "dismissed");
  EXPECT_STREQ(Name(EventStatus::kUndecided), "undecided");
  EXPECT_STREQ(Name(EventStatus::kWithdrawn), "withdrawn");
  EXPECT_STREQ(Name(EventStatus::kEnded), "ended");
}

}  // namespace
}  // namespace collision::client
