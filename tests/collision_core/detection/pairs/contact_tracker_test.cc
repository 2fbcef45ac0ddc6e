// Goal:   results over segments become brackets that contain every begin and end, and nothing
//         certain is lost.
// Method: hand-made results whose brackets are known; one second a segment.
#include "collision_core/detection/pairs/contact_tracker.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Instant At(double seconds) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(seconds * kSecond));
}

narrow_phase::SegmentResult Free() { return {1, 1, 0, true, 0}; }
narrow_phase::SegmentResult Undecided() { return {0, 1, 0, true, 1}; }
narrow_phase::SegmentResult Touching() { return {0, 0, 1, true, 1}; }

void Apply(ContactTracker* tracker, const narrow_phase::SegmentResult& verdict) {
  tracker->Apply(verdict, numeric::AddRoundedDown(tracker->at(), 1), NearestInstant{},
                 narrow_phase::ContactNormal{});
}

TEST(ContactTracker, ContactInsideOneSegment) {
  ContactTracker tracker(At(0), Past::kKnown);
  Apply(&tracker, {0.25, 0.5, 0.625, true, 0.75});
  ASSERT_EQ(tracker.finished().size(), 1u);
  const ContactEpisode episode = tracker.TakeFinished()[0];
  EXPECT_TRUE(episode.contact);
  EXPECT_TRUE(episode.continuous);
  EXPECT_EQ(episode.begin, (TimeBracket{At(0.25), At(0.5)}));
  EXPECT_EQ(episode.end, (TimeBracket{At(0.625), At(0.75)}));
  EXPECT_TRUE(tracker.free());
  EXPECT_EQ(tracker.free_until(), At(1));
}

// Times between two nanoseconds: each end goes to the side that claims less.
TEST(ContactTracker, EndsAreRoundedOutward) {
  ContactTracker tracker(At(0), Past::kKnown);
  Apply(&tracker, {100.5e-9, 200.5e-9, 300.5e-9, true, 400.5e-9});
  const ContactEpisode episode = tracker.TakeFinished().at(0);
  const auto nanoseconds = [](std::int64_t ns) { return Instant::FromNanoseconds(ns); };
  EXPECT_EQ(episode.begin, (TimeBracket{nanoseconds(100), nanoseconds(201)}));
  EXPECT_EQ(episode.end, (TimeBracket{nanoseconds(300), nanoseconds(401)}));
}

// One bound says apart where the other says touching: nothing is certain there, but brackets stay
// in order and hold both.
TEST(ContactTracker, ContradictingBoundsKeepBracketsInOrder) {
  ContactTracker tracker(At(0), Past::kKnown);
  Apply(&tracker, {0.5, 0.25, 0.75, true, 1});
  EXPECT_EQ(tracker.episode().begin, (TimeBracket{At(0.25), At(0.5)}));
  EXPECT_EQ(tracker.episode().end.earliest, At(0.75));
  ContactTracker never(At(0), Past::kKnown);
  Apply(&never, {0.75, 0.5, 0.625, true, 0.25});
  EXPECT_FALSE(never.in_contact());
  ASSERT_EQ(never.finished().size(), 1u);
  EXPECT_FALSE(never.finished()[0].contact);
  EXPECT_EQ(never.finished()[0].begin, (TimeBracket{At(0.5), At(0.625)}));
}

TEST(ContactTracker, ContactAcrossSegmentsJoins) {
  ContactTracker tracker(At(0), Past::kKnown);
  Apply(&tracker, Free());
  Apply(&tracker, {0.5, 0.75, 1, true, 1});
  EXPECT_TRUE(tracker.in_contact());
  EXPECT_EQ(tracker.episode().begin, (TimeBracket{At(1.5), At(1.75)}));
  Apply(&tracker, Touching());
  Apply(&tracker, {0, 0, 0.5, true, 0.75});
  const ContactEpisode episode = tracker.TakeFinished().at(0);
  EXPECT_TRUE(episode.continuous);
  EXPECT_EQ(episode.end, (TimeBracket{At(3.5), At(3.75)}));
}

// After an uncertain gap the first contact may have ended in it: the end bracket must contain both
// cases.
TEST(ContactTracker, GapInContactIsReported) {
  ContactTracker tracker(At(0), Past::kKnown);
  Apply(&tracker, {0.5, 0.75, 1, true, 1});
  Apply(&tracker, Undecided());
  Apply(&tracker, {0, 0, 0.25, true, 0.5});
  const ContactEpisode episode = tracker.TakeFinished().at(0);
  EXPECT_FALSE(episode.continuous);
  EXPECT_EQ(episode.end, (TimeBracket{At(1), At(2.5)}));
}

TEST(ContactTracker, UndecidedBracketIsTheWholeGap) {
  ContactTracker tracker(At(0), Past::kKnown);
  Apply(&tracker, {0.5, 1, 0, true, 1});
  Apply(&tracker, Undecided());
  EXPECT_FALSE(tracker.free());
  EXPECT_FALSE(tracker.in_contact());
  Apply(&tracker, Free());
  const ContactEpisode episode = tracker.TakeFinished().at(0);
  EXPECT_FALSE(episode.contact);
  EXPECT_EQ(episode.begin, (TimeBracket{At(0.5), At(2)}));
  EXPECT_EQ(episode.end, (TimeBracket{At(0.5), At(2)}));
}

TEST(ContactTracker, FreeAtStartClosesThere) {
  ContactTracker tracker(At(0), Past::kKnown);
  Apply(&tracker, {0.5, 0.75, 1, true, 1});
  Apply(&tracker, {0.25, 0.5, 1, true, 1});
  ASSERT_EQ(tracker.finished().size(), 1u);
  EXPECT_EQ(tracker.finished()[0].end, (TimeBracket{At(1), At(1)}));
  EXPECT_EQ(tracker.episode().begin, (TimeBracket{At(1.25), At(1.5)}));
}

TEST(ContactTracker, RetractionMovesFreedomBackOnly) {
  ContactTracker tracker(At(0), Past::kKnown);
  tracker.ExtendFree(At(9));
  tracker.RetractFree(At(3), Past::kKnown);
  EXPECT_EQ(tracker.free_until(), At(3));
  tracker.RetractFree(At(5), Past::kUnknown);
  EXPECT_EQ(tracker.free_until(), At(3));
  Apply(&tracker, Touching());
  EXPECT_TRUE(tracker.episode().began_before);
}

}  // namespace
}  // namespace collision::detection
