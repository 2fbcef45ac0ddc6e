// Goal:   the results of several evaluations of one contact are combined without claiming more than
//         any of them.
// Method: hand-made results for a pair whose event is confirmed by one evaluation and ended by
//         another; one second a segment.
#include "collision_core/detection/events/announcer.h"

#include <gtest/gtest.h>

#include "collision_core/detection/pairs/contact_tracker.h"

namespace collision::detection {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Instant At(double seconds) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(seconds * kSecond));
}

/// Records the instants for which it is called.
class AskedEncounter final : public EncounterSource {
 public:
  EncounterAnswer At(Instant at) override {
    called_for.push_back(at);
    EncounterAnswer answer;
    answer.found.separation.upper = -0.5;
    answer.work = 7;
    return answer;
  }

  ExpectationAnswer Expected() override {
    ++expected;
    ExpectationAnswer answer;
    answer.expected.emplace().outcome = ExpectedOutcome::kPass;
    return answer;
  }

  std::vector<Instant> called_for;
  int expected = 0;
};

class AnnouncerTest : public testing::Test {
 protected:
  /// An evaluation of [0, 1] with this result.
  static ContactTracker Look(const narrow_phase::SegmentResult& verdict) {
    ContactTracker tracker(At(0), Past::kKnown);
    tracker.Apply(verdict, At(1), NearestInstant{}, narrow_phase::ContactNormal{});
    return tracker;
  }

  CollisionEvent Report(ContactTracker settled, const ContactTracker& preview) {
    announcer_.Start(At(2));
    std::vector<ContactEpisode> taken;
    const PairOutlook outlook = OutlookOf(&settled, preview, &taken);
    announcer_.Report(pair_, outlook, Finality::kOngoing, &encounter_, &published_);
    return announcer_.events().empty() ? CollisionEvent{} : announcer_.events().back();
  }

  /// One evaluation confirms the contact; a later, final one gives its end.
  CollisionEvent EndOf(const narrow_phase::SegmentResult& first,
                       const narrow_phase::SegmentResult& last) {
    const ContactTracker nothing(At(0), Past::kKnown);
    EXPECT_EQ(Report(nothing, Look(first)).status, EventStatus::kConfirmed);
    const CollisionEvent ended = Report(Look(last), ContactTracker(Instant::Never(), Past::kKnown));
    EXPECT_EQ(ended.status, EventStatus::kEnded);
    return ended;
  }

  DetectorOptions options_;
  DetectorCounters counters_;
  Announcer announcer_{options_, &counters_};
  const PairName pair_{{.slot = 0}, {.slot = 1}, AgentIndex(0u), AgentIndex(1u), PairSlot(3u)};
  AskedEncounter encounter_;
  PublishedEvent published_;
};

TEST_F(AnnouncerTest, EvaluationsThatOverlapAreOneContact) {
  const CollisionEvent ended =
      EndOf({0.125, 0.25, 0.5, true, 1}, {0.1875, 0.375, 0.75, true, 0.875});
  EXPECT_TRUE(ended.continuous);
  EXPECT_EQ(ended.begin, (TimeBracket{At(0.1875), At(0.25)}));
  EXPECT_EQ(ended.end, (TimeBracket{At(0.75), At(0.875)}));
}

// The first was certain of [0.25, 0.5], the second of [0.625, 0.75]: between these the two may have
// been apart.
TEST_F(AnnouncerTest, EvaluationsThatDoNotMeetMayBeTwoContacts) {
  const CollisionEvent ended =
      EndOf({0.125, 0.25, 0.5, true, 1}, {0.125, 0.625, 0.75, true, 0.875});
  EXPECT_FALSE(ended.continuous);
  EXPECT_EQ(ended.begin, (TimeBracket{At(0.125), At(0.25)}));
  EXPECT_EQ(ended.end.latest, At(0.875));
}

TEST_F(AnnouncerTest, AnEarlierEvaluationKnewTheEndBetter) {
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

// After a breach nothing published under the broken bound holds.
TEST_F(AnnouncerTest, ABrokenBoundTakesBackWhatWasPublished) {
  const ContactTracker nothing(At(0), Past::kKnown);
  Report(nothing, Look({0.125, 0.25, 0.8125, true, 1}));
  published_.broken = true;
  const CollisionEvent ended = Report(Look({0.0625, 0.375, 0.5, true, 0.875}),
                                      ContactTracker(Instant::Never(), Past::kKnown));
  EXPECT_EQ(ended.begin, (TimeBracket{At(0.0625), At(0.375)}));
  EXPECT_EQ(ended.end, (TimeBracket{At(0.5), At(0.875)}));
}

// Goal:   proximity is computed at the instant that is published, and nowhere else.
TEST_F(AnnouncerTest, ComputesProximityAtTheFirstCertainContactAlone) {
  const ContactTracker nothing(At(0), Past::kKnown);
  const CollisionEvent confirmed = Report(nothing, Look({0.125, 0.25, 0.5, true, 1}));
  EXPECT_EQ(encounter_.called_for, std::vector<Instant>{At(0.25)});
  EXPECT_EQ(confirmed.evaluated_at, At(0.25));
  EXPECT_EQ(confirmed.separation_upper, -0.5);
  EXPECT_EQ(confirmed.pair_slot, 3u);
  Report(nothing, Look({0.125, 0.25, 0.5, true, 1}));
  EXPECT_EQ(encounter_.called_for.size(), 1u) << "nothing is narrower than what was published";
}

// Goal:   what a pair's event becomes when it is not watched any longer says what is known.
TEST_F(AnnouncerTest, ClosesWhatIsOpen) {
  const ContactTracker nothing(At(0), Past::kKnown);
  const auto status_of = [&](const ContactEpisode* open, Departure departure) {
    announcer_.Start(At(3));
    announcer_.Close(pair_, open, departure, At(2.75), &published_);
    EXPECT_FALSE(published_.announced);
    return announcer_.events().back();
  };
  Report(nothing, ContactTracker(At(2.5), Past::kKnown));  // free until 2.5 s: possible
  EXPECT_EQ(status_of(nullptr, Departure::kRemoved).status, EventStatus::kWithdrawn);
  Report(nothing, ContactTracker(At(2.5), Past::kKnown));
  const ContactTracker doubt = Look({0.5, 1, 0, true, 1});
  const CollisionEvent undecided = status_of(&doubt.episode(), Departure::kRemoved);
  EXPECT_EQ(undecided.status, EventStatus::kUndecided);
  EXPECT_EQ(undecided.begin, (TimeBracket{At(0.5), At(2.75)}));
  Report(nothing, Look({0.125, 0.25, 1, true, 1}));
  const CollisionEvent ended = status_of(nullptr, Departure::kRemoved);
  EXPECT_EQ(ended.status, EventStatus::kEnded);
  EXPECT_EQ(ended.end.latest, At(2.75));
  Report(nothing, Look({0.125, 0.25, 1, true, 1}));
  EXPECT_TRUE(status_of(nullptr, Departure::kUnwatched).end.latest.is_never());
  announcer_.Start(At(4));
  announcer_.Close(pair_, nullptr, Departure::kRemoved, At(4), &published_);
  EXPECT_TRUE(announcer_.events().empty()) << "nothing is open";
}

}  // namespace
}  // namespace collision::detection
