// Goal:   what several looks at one contact tell is put together without claiming more than any of
// them. Method: hand-made verdicts on a pair whose event is confirmed by one look and ended by
// another; one second a segment.
#include "collision_core/detection/announcer.h"

#include <gtest/gtest.h>

namespace collision::detection {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Instant At(double seconds) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(seconds * kSecond));
}

AgentRecord BallAt(std::uint32_t slot, double x) {
  AgentRecord record;
  record.id.slot = slot;
  motion::MotionState state;
  state.stamp = At(0);
  state.p_WA = {x, 0, 0};
  motion::AgentDeclaration declaration;
  declaration.radius = 1;
  record.history.Push({state, declaration, 0}, Link::kJumped, 4);
  return record;
}

class AnnouncerTest : public testing::Test {
 protected:
  AnnouncerTest() {
    slot_ = *pairs_.Add(
        {.lower = 0, .higher = 1, .tracker = ContactTracker(At(0), false), .clear_until = At(0)});
  }

  /// A look at [0, 1] that finds this.
  static ContactTracker Look(const narrow_phase::SegmentResult& verdict) {
    ContactTracker tracker(At(0), false);
    tracker.Apply(verdict, At(1), Nearest{}, narrow_phase::ContactNormal{});
    return tracker;
  }

  CollisionEvent Report(const ContactTracker& settled, const ContactTracker& preview) {
    pairs_[slot_].tracker = settled;
    announcer_.Start(At(2));
    announcer_.Report(lower_, higher_, slot_, preview, 1000, false, &pairs_);
    return announcer_.events().empty() ? CollisionEvent{} : announcer_.events().back();
  }

  /// One look confirms, a later one, which is final, tells of the end.
  CollisionEvent EndOf(const narrow_phase::SegmentResult& first,
                       const narrow_phase::SegmentResult& last) {
    const ContactTracker nothing(At(0), false);
    EXPECT_EQ(Report(nothing, Look(first)).status, EventStatus::kConfirmed);
    const CollisionEvent ended = Report(Look(last), ContactTracker(Instant::Never(), false));
    EXPECT_EQ(ended.status, EventStatus::kEnded);
    return ended;
  }

  DetectorOptions options_;
  DetectorCounters counters_;
  Announcer announcer_{options_, &counters_};
  PairTable pairs_{4};
  AgentRecord lower_ = BallAt(0, 0), higher_ = BallAt(1, 1);
  std::uint32_t slot_ = 0;
};

TEST_F(AnnouncerTest, LooksThatOverlapAreOneContact) {
  const CollisionEvent ended =
      EndOf({0.125, 0.25, 0.5, true, 1}, {0.1875, 0.375, 0.75, true, 0.875});
  EXPECT_TRUE(ended.continuous);
  EXPECT_EQ(ended.begin, (TimeBracket{At(0.1875), At(0.25)}));
  EXPECT_EQ(ended.end, (TimeBracket{At(0.75), At(0.875)}));
}

// The first was certain of [0.25, 0.5], the second of [0.625, 0.75]: between these the two may have been
// apart.
TEST_F(AnnouncerTest, LooksThatDoNotMeetMayBeTwoContacts) {
  const CollisionEvent ended =
      EndOf({0.125, 0.25, 0.5, true, 1}, {0.125, 0.625, 0.75, true, 0.875});
  EXPECT_FALSE(ended.continuous);
  EXPECT_EQ(ended.begin, (TimeBracket{At(0.125), At(0.25)}));
  EXPECT_EQ(ended.end.latest, At(0.875));
}

TEST_F(AnnouncerTest, AnEarlierLookKnewTheEndBetter) {
  const CollisionEvent ended =
      EndOf({0.125, 0.25, 0.8125, true, 1}, {0.125, 0.375, 0.5, true, 0.875});
  EXPECT_TRUE(ended.continuous);
  EXPECT_EQ(ended.end, (TimeBracket{At(0.8125), At(0.875)}));
}

// What was certain of a contact after this one's end says nothing of this one.
TEST_F(AnnouncerTest, WhatLiesBeyondTheEndIsAnotherContact) {
  const CollisionEvent ended =
      EndOf({0.125, 0.875, 0.9375, true, 1}, {0.125, 0.25, 0.5, true, 0.75});
  EXPECT_TRUE(ended.continuous);
  EXPECT_EQ(ended.begin, (TimeBracket{At(0.125), At(0.25)}));
  EXPECT_EQ(ended.end, (TimeBracket{At(0.5), At(0.75)}));
  const CollisionEvent& before = announcer_.events().front();
  EXPECT_EQ(before.status, EventStatus::kConfirmed);
  EXPECT_TRUE(before.continuous);
  EXPECT_EQ(before.end.earliest, At(0.5));
}

// After a breach nothing holds that was told under the broken bound.
TEST_F(AnnouncerTest, ABrokenBoundTakesBackWhatWasTold) {
  const ContactTracker nothing(At(0), false);
  Report(nothing, Look({0.125, 0.25, 0.8125, true, 1}));
  pairs_[slot_].broken = true;
  const CollisionEvent ended =
      Report(Look({0.0625, 0.375, 0.5, true, 0.875}), ContactTracker(Instant::Never(), false));
  EXPECT_EQ(ended.begin, (TimeBracket{At(0.0625), At(0.375)}));
  EXPECT_EQ(ended.end, (TimeBracket{At(0.5), At(0.875)}));
}

}  // namespace
}  // namespace collision::detection
