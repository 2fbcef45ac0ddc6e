// Goal:   a line says what the event says, rounded outward, in columns.
// Method: whole lines compared; instants at the ends of their range.
#include "client/event_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "client/types.h"

namespace collision::client {
namespace {

std::string NameOf(const v1::AgentId& id) { return id.slot() == 0 ? "iridium-33" : "cosmos-2251"; }

v1::CollisionEvent Confirmed() {
  v1::CollisionEvent event;
  event.set_now_ns(599'734'999'999);
  event.mutable_higher()->set_slot(1);
  event.set_contact(1);
  event.set_revision(3);
  event.set_status(v1::EVENT_CONFIRMED);
  event.mutable_begin()->set_earliest_ns(599'734'236'999);
  event.mutable_begin()->set_latest_ns(599'734'369'001);
  event.mutable_end()->set_earliest_ns(599'734'369'001);
  event.mutable_end()->set_latest_ns(kNever);
  event.set_evaluated_at_ns(599'734'370'000);
  event.mutable_separation_m()->set_lower(-3);
  event.mutable_separation_m()->set_upper(-0.1234);
  return event;
}

TEST(EventText, AConfirmedEvent) {
  EXPECT_EQ(EventLine(Confirmed(), NameOf, 0),
            "    599.734 s  confirmed  iridium-33 × cosmos-2251      #1 r3  "
            "begin [599.734236, 599.734370]  end open  gap ≤ -0.123 m");
}

TEST(EventText, APossibleEventWithOpenBeginOnAWallClock) {
  v1::CollisionEvent event = Confirmed();
  event.set_status(v1::EVENT_POSSIBLE);
  event.mutable_begin()->set_latest_ns(kNever);
  event.mutable_separation_m()->set_lower(0.012345);
  event.mutable_separation_m()->set_upper(1234.5);
  EXPECT_EQ(EventLine(event, NameOf, 599'000'000'000),
            "      0.734 s  possible   iridium-33 × cosmos-2251      #1 r3  "
            "begin [0.734236, open]  end open  gap [0.0123, 1.24e+03] m");
}

v1::CollisionEvent OfShapes() {
  v1::CollisionEvent event = Confirmed();
  event.set_depth_lower_m(0.2345);
  event.mutable_point_m()->set_x(1.25);
  event.mutable_point_m()->set_y(-1234.56789);
  event.mutable_point_m()->set_z(-0.0);
  event.set_point_error_m(0.16);
  event.mutable_normal()->set_x(0.6);
  event.mutable_normal()->set_y(-0.8);
  event.set_normal_error_rad(0.0873);
  event.set_level(6);
  event.set_work_units(1840);
  event.set_limited_by(v1::LIMIT_BUDGET);
  return event;
}

std::string FromGap(const v1::CollisionEvent& event) {
  const std::string line = EventLine(event, NameOf, 0);
  return line.substr(line.find("  gap"));
}

// Digits that are left out count to the error: 0.87 of a hundredth of a metre, 0.05 degrees.
TEST(EventText, AContactOfShapesSaysWhereHowDeepAndWhatLimitedIt) {
  EXPECT_EQ(FromGap(OfShapes()),
            "  gap [-3, -0.123] m  depth ≥ 0.234 m  at (1.25, -1234.57, 0.00) ± 0.169 m  "
            "normal (0.600, -0.800, 0.000) ± 5.06°  level 6, 1840 units, limited by budget");
}

TEST(EventText, OfShapesOnlyWhatIsKnownIsSaid) {
  v1::CollisionEvent event = OfShapes();
  event.set_normal_error_rad(3.1415926535897936);
  event.set_depth_lower_m(0);
  event.set_point_error_m(0);
  event.set_limited_by(v1::LIMIT_NONE);
  EXPECT_EQ(FromGap(event),
            "  gap [-3, -0.123] m  at (1.250000000, -1234.567890000, 0.000000000) ± 8.67e-10 m  "
            "level 6, 1840 units");
  event.set_point_error_m(1e6);
  EXPECT_NE(FromGap(event).find("  at (1, -1235, 0) ± 1.01e+06 m"), std::string::npos)
      << FromGap(event);
  event.mutable_separation_m()->set_upper(0.5);
  event.set_limited_by(v1::LIMIT_GEOMETRY);
  EXPECT_EQ(FromGap(event), "  gap [-3, 0.5] m  level 6, 1840 units, limited by geometry");
  event.set_limited_by(v1::LIMIT_MOTION);
  EXPECT_NE(FromGap(event).find(", limited by motion"), std::string::npos);
}

// A ball's surface is known: nothing was searched.
TEST(EventText, BallsHaveNoLevel) {
  v1::CollisionEvent event = OfShapes();
  event.set_level(0);
  EXPECT_EQ(FromGap(event), "  gap ≤ -0.123 m");
}

// What may be older than the pair has no time before which they did not touch.
TEST(EventText, AContactThatBeganBeforeHasNoEarliestBegin) {
  v1::CollisionEvent event = Confirmed();
  event.set_began_before(true);
  event.clear_separation_m();
  std::string line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("  begin")), "  begin ≤ 599.734370 (began before)  end open");
  event.mutable_begin()->set_latest_ns(kNever);
  line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("  begin")), "  begin open (began before)  end open");
}

// Whether they touched at all is not known.
TEST(EventText, AnUndecidedEventHasNeitherBeginNorEnd) {
  v1::CollisionEvent event = Confirmed();
  event.set_status(v1::EVENT_UNDECIDED);
  event.mutable_end()->set_latest_ns(599'857'266'001);
  event.mutable_separation_m()->set_lower(-0.5);
  event.mutable_separation_m()->set_upper(0.5);
  EXPECT_EQ(EventLine(event, NameOf, 0),
            "    599.734 s  undecided  iridium-33 × cosmos-2251      #1 r3  "
            "not certified free in [599.734236, 599.857267]  gap [-0.5, 0.5] m");
  event.set_began_before(true);
  event.mutable_end()->set_latest_ns(kNever);
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
  v1::CollisionEvent event = Confirmed();
  event.set_now_ns(kStamp);
  event.mutable_begin()->set_earliest_ns(kStamp);
  EXPECT_EQ(EventLine(event, NameOf, 0).substr(0, 29), "02:58:15.022 UTC  confirmed  ");
}

TEST(EventText, AGapOfNothingHasNoSign) {
  v1::CollisionEvent event = Confirmed();
  event.mutable_separation_m()->set_upper(-0.0);
  const std::string line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("gap")), "gap ≤ 0 m");
}

TEST(EventText, AnEndSaysWhatIsKnownOfIt) {
  v1::CollisionEvent event = Confirmed();
  event.clear_separation_m();
  event.mutable_end()->set_earliest_ns(599'734'400'000);
  EXPECT_NE(EventLine(event, NameOf, 0).find("  end ≥ 599.734400"), std::string::npos);
  event.mutable_end()->set_latest_ns(599'857'266'001);
  const std::string line = EventLine(event, NameOf, 0);
  EXPECT_EQ(line.substr(line.find("  end")), "  end [599.734400, 599.857267]");
}

TEST(EventText, SecondsRoundTheWayAskedForAtAnyInstant) {
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
  EXPECT_STREQ(StatusText(v1::EVENT_POSSIBLE), "possible");
  EXPECT_STREQ(StatusText(v1::EVENT_CONFIRMED), "confirmed");
  EXPECT_STREQ(StatusText(v1::EVENT_DISMISSED), "dismissed");
  EXPECT_STREQ(StatusText(v1::EVENT_UNDECIDED), "undecided");
  EXPECT_STREQ(StatusText(v1::EVENT_WITHDRAWN), "withdrawn");
  EXPECT_STREQ(StatusText(v1::EVENT_ENDED), "ended");
}

}  // namespace
}  // namespace collision::client
