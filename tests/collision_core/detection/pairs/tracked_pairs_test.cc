// Goal:   a tracked pair is evaluated when it is due or one of its agents has changed, and at no
//         other step; a pair that is far apart again is released with a key that covers it.
// Method: unit balls on the x-axis without acceleration, whose times of meeting are exact; the
//         tables are walked after each step.
#include "collision_core/detection/pairs/tracked_pairs.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

class TrackedPairsTest : public testing::Test {
 protected:
  /// A state of the agent at 0 s.
  void Place(AgentIndex agent, double x, double speed) {
    agents_.Store(agent, State(0, {x, 0, 0}, {speed, 0, 0}), Link::kJumped);
  }

  void SetUp() override {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const AgentIndex agent = agents_.Admit(Id(k), {.limits = {.radius = 1}}, At(0));
      Place(agent, 100 * k, 0);
      pairs_.AddAgent(agent);
    }
    EndStep();
  }

  void EndStep() {
    agents_.EndStep([](AgentIndex) { return Instant::Always(); });
  }

  /// All owners have reported everything up to `now`.
  void Step(double now) {
    for (std::uint32_t k = 0; k < 3; ++k) agents_.SetHeardUntil(OwnerOf(Id(k)), At(now));
    clock_.now = At(now);
    ++clock_.step;
    pairs_.StartStep();
    pairs_.EvaluateDuePairs();
    pairs_.Validate();
    EndStep();
  }

  /// The only pair of the agent.
  const PairRecord& PairOf(AgentIndex agent) const {
    return pairs_.table()[pairs_.table().Of(agent).at(0)];
  }

  bool WasEvaluated(AgentIndex agent) const { return PairOf(agent).evaluated_step == clock_.step; }

  const AgentIndex a_{0u}, b_{1u}, c_{2u};
  const DetectorOptions options_{
      .temporal_resolution = 1.0 / 64, .announce_within = 2, .pairs_per_agent_max = 1};
  StepClock clock_{.now = At(0), .announce_within = 2};
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  TrackedPairs pairs_{options_, {clock_, agents_, &counters_, &dirty_}};
};

TEST_F(TrackedPairsTest, ANewPairIsQueuedAndItsAgentsClearancesMayHaveChanged) {
  ASSERT_TRUE(pairs_.Track(b_, a_, At(10), Past::kKnown));
  EXPECT_EQ(PairOf(a_).lower, a_) << "in the order of ids";
  EXPECT_EQ(PairOf(b_).higher, b_);
  EXPECT_EQ(pairs_.queued(), 1u);
  EXPECT_EQ(pairs_.changed()->size(), 1u);
  EXPECT_TRUE(dirty_.Contains(a_) && dirty_.Contains(b_));
  EXPECT_FALSE(dirty_.Contains(c_));
}

// Two agents that rest 98 m apart.
TEST_F(TrackedPairsTest, ANewPairIsDueWhenItsFreedomIsAsNearAsWhatIsAnnounced) {
  ASSERT_TRUE(pairs_.Track(a_, b_, At(10), Past::kKnown));
  Step(7.999);
  EXPECT_FALSE(WasEvaluated(a_));
  Step(8);
  EXPECT_EQ(pairs_.table().size(), 0u) << "they do not meet, so the pair is released";
}

TEST_F(TrackedPairsTest, APairWithoutRoomIsNotTracked) {
  ASSERT_TRUE(pairs_.Track(a_, b_, At(10), Past::kKnown));
  EXPECT_FALSE(pairs_.Track(a_, c_, At(10), Past::kKnown));
  EXPECT_FALSE(pairs_.Track(c_, a_, At(10), Past::kKnown));
  EXPECT_EQ(pairs_.table().size(), 1u);
  EXPECT_EQ(pairs_.queued(), 1u);
  EXPECT_FALSE(dirty_.Contains(c_));
}

// They meet at 2.25 s: too late to be announced at 0 s, too early to be released.
TEST_F(TrackedPairsTest, APairIsDueWhenItIsToBeAnnounced) {
  Place(b_, 11, -4);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  ASSERT_TRUE(WasEvaluated(a_));
  EXPECT_TRUE(pairs_.events().empty());
  Step(0.2);
  EXPECT_FALSE(WasEvaluated(a_));
  Step(0.25);
  EXPECT_TRUE(WasEvaluated(a_));
  ASSERT_EQ(pairs_.events().size(), 1u);
  EXPECT_EQ(pairs_.events()[0].status, EventStatus::kPossible);
  EXPECT_LE(pairs_.events()[0].begin.earliest, At(2.25));
  EXPECT_GT(pairs_.events()[0].begin.earliest, At(2.2499));
}

// They meet at 1 s.
TEST_F(TrackedPairsTest, AnAnnouncedPairIsDueTheTemporalResolutionBeforeItsMeeting) {
  Place(b_, 10, -8);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  ASSERT_EQ(pairs_.events().size(), 1u);
  Step(0.5);
  EXPECT_FALSE(WasEvaluated(a_));
  Step(1 - 1.5 / 64);
  EXPECT_FALSE(WasEvaluated(a_));
  Step(1 - 1.0 / 64);
  EXPECT_TRUE(WasEvaluated(a_));
}

TEST_F(TrackedPairsTest, APairIsEvaluatedWhenOneOfItsAgentsHasChanged) {
  Place(b_, 10, -8);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  agents_.MarkChanged(c_);
  Step(0.25);
  EXPECT_FALSE(WasEvaluated(a_));
  agents_.MarkChanged(b_);
  Step(0.5);
  EXPECT_TRUE(WasEvaluated(a_));
}

TEST_F(TrackedPairsTest, WhereFewPairsAreTrackedAContactDoesNotRest) {
  Place(b_, 1, 0);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kUnknown));
  for (const double now : {0.5, 0.5625, 0.625}) {
    Step(now);
    EXPECT_TRUE(WasEvaluated(a_)) << now;
    EXPECT_TRUE(PairOf(a_).in_contact) << now;
  }
}

// They touch from 0.25 s to 0.75 s.
TEST_F(TrackedPairsTest, AContactIsEvaluatedAtEachStepUntilItHasEnded) {
  Place(b_, 4, -8);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  for (const double now : {0.5, 0.5625, 0.625}) {
    Step(now);
    EXPECT_TRUE(WasEvaluated(a_)) << now;
    EXPECT_TRUE(PairOf(a_).in_contact) << now;
  }
  Step(1);
  EXPECT_TRUE(WasEvaluated(a_));
  EXPECT_FALSE(PairOf(a_).in_contact);
}

// They meet at 8 s, which a key can cover.
TEST_F(TrackedPairsTest, APairThatIsFarApartIsReleasedOnceWithAKeyBeforeItsMeeting) {
  Place(b_, 10, -1);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  EXPECT_EQ(pairs_.table().size(), 0u);
  EXPECT_EQ(pairs_.queued(), 0u);
  const std::vector<ReleasedPair> released = pairs_.TakeReleased();
  ASSERT_EQ(released.size(), 1u);
  EXPECT_EQ(released[0].lower, a_);
  EXPECT_EQ(released[0].higher, b_);
  EXPECT_LE(released[0].clear_until, At(8));
  EXPECT_GT(released[0].clear_until, At(7.999));
  EXPECT_TRUE(pairs_.TakeReleased().empty());
}

// No key may lie before a state of its agent: A has reported more than the time of the meeting.
TEST_F(TrackedPairsTest, APairThatMeetsBeforeAStateStaysTracked) {
  Place(b_, 10, -1);
  agents_.Store(a_, State(9, {0, 0, 0}, {0, 0, 0}), Link::kFollows);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  EXPECT_EQ(pairs_.table().size(), 1u);
  EXPECT_TRUE(pairs_.TakeReleased().empty());
}

TEST_F(TrackedPairsTest, AMaskThatExcludesAPairEndsItsTracking) {
  Place(b_, 10, -8);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  agents_[b_].declaration.filter.mask = 0;
  agents_.MarkChanged(b_);
  Step(0.25);
  ASSERT_EQ(pairs_.events().size(), 1u);
  EXPECT_EQ(pairs_.events()[0].status, EventStatus::kWithdrawn);
  EXPECT_EQ(pairs_.table().size(), 0u);
  EXPECT_TRUE(pairs_.TakeReleased().empty()) << "no key has to cover it";
}

TEST_F(TrackedPairsTest, AnAgentThatLeavesTakesItsPairsAlong) {
  Place(b_, 10, -8);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  Step(0);
  EXPECT_THROW(pairs_.ForgetAgent(a_), CheckFailure);
  clock_.now = At(0.25);
  pairs_.StartStep();
  pairs_.EvaluateLastTime(a_, Departure::kRemoved);
  ASSERT_EQ(pairs_.events().size(), 1u);
  EXPECT_EQ(pairs_.events()[0].status, EventStatus::kWithdrawn);
  EXPECT_EQ(pairs_.table().size(), 0u);
  EXPECT_EQ(pairs_.queued(), 0u);
  EXPECT_TRUE(pairs_.TakeReleased().empty());
  pairs_.ForgetAgent(a_);
}

TEST_F(TrackedPairsTest, OfTheRetractionsOfAStepTheEarliestIsKept) {
  ASSERT_TRUE(pairs_.Track(a_, b_, At(10), Past::kKnown));
  for (int k = 0; k < 1000; ++k) pairs_.RetractFree(k % 2 == 0 ? a_ : b_, At(7 - k % 3));
  EXPECT_EQ(pairs_.retracted(), 1u);
  EXPECT_EQ(PairOf(a_).retracted_from, At(5));
  Step(0);
  EXPECT_EQ(pairs_.retracted(), 0u);
}

TEST_F(TrackedPairsTest, RetractedFreedomNeedsOlderStates) {
  ASSERT_TRUE(pairs_.Track(a_, b_, At(10), Past::kKnown));
  EXPECT_EQ(pairs_.ExtremesOf(a_).needed_from, At(10));
  EXPECT_EQ(pairs_.ExtremesOf(c_).needed_from, Instant::Never());
  pairs_.RetractFree(b_, At(4));
  EXPECT_EQ(pairs_.ExtremesOf(a_).needed_from, At(4));
  EXPECT_FALSE(PairOf(a_).published.broken);
  pairs_.MarkBroken(a_, At(3));
  EXPECT_EQ(pairs_.ExtremesOf(b_).needed_from, At(3));
  EXPECT_TRUE(PairOf(a_).published.broken);
}

}  // namespace
}  // namespace collision::detection
