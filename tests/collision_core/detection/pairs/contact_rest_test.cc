// Goal:   a contact of two balls rests until it may end, never longer than allowed, and never where
//         something else may change what is known of it.
// Method: two unit balls of which one moves away along x, in numbers whose sums are exact; each
//         precondition of a rest is broken once.
#include "collision_core/detection/pairs/contact_rest.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

constexpr double kLong = 100;  // [s]

narrow_phase::SegmentResult Touching() { return {0, 0, 1, true, 1}; }
narrow_phase::SegmentResult Undecided() { return {0, 1, 0, true, 1}; }

/// A unit ball on the x-axis, as of 1 s.
History::Sample Ball(double x, double speed) {
  return {.bound = {State(1, {x, 0, 0}, {speed, 0, 0}), {.radius = 1, .acceleration_max = 1}, 0}};
}

/// A tracker of [0, 1] with this result.
ContactTracker Tracked(const narrow_phase::SegmentResult& first) {
  ContactTracker tracker(At(0), Past::kKnown);
  tracker.Apply(first, At(1), NearestInstant{}, narrow_phase::ContactNormal{});
  return tracker;
}

/// A copy that ran ahead to 2 s.
ContactTracker Ahead(ContactTracker tracker, const narrow_phase::SegmentResult& next) {
  tracker.Apply(next, At(2), NearestInstant{}, narrow_phase::ContactNormal{});
  return tracker;
}

class ContactRestTest : public testing::Test {
 protected:
  Instant RestsUntil(double now, double longest = kLong) const {
    return ContactRestsUntil({a_, b_, lowerable_, preview_}, At(now), longest);
  }

  History::Sample a_ = Ball(0, 0);
  History::Sample b_ = Ball(1, 0.125);  // the balls overlap by 1 m at 1 s, and by nothing at 9 s
  ContactTracker lowerable_ = Tracked({0.25, 0.5, 1, true, 1});
  ContactTracker preview_ = Ahead(lowerable_, Touching());
};

// Rounding may end the rest earlier, by no more than two nanoseconds, and never later.
TEST_F(ContactRestTest, LastsUntilTheRelativeSpeedHasUsedUpTheOverlap) {
  for (const double now : {2.0, 5.0, 8.5}) {
    EXPECT_LE(RestsUntil(now), At(9)) << now;
    EXPECT_GE(RestsUntil(now), At(9 - 2e-9)) << now;
  }
}

TEST_F(ContactRestTest, IsNoLongerThanAllowed) {
  EXPECT_EQ(RestsUntil(2, 0.5), At(2.5));
  b_ = Ball(1, 0);
  EXPECT_EQ(RestsUntil(2), At(102)) << "without relative speed nothing ends it";
}

// The direction does not count: the two may also pass through each other.
TEST_F(ContactRestTest, CountsTheSpeedOfAnApproachToo) {
  b_ = Ball(1, -0.125);
  EXPECT_LT(RestsUntil(2), At(100));
  EXPECT_GT(RestsUntil(2), At(2));
}

TEST_F(ContactRestTest, NeedsAnOverlapNowAndAtTheLastEvaluation) {
  EXPECT_EQ(RestsUntil(9), Instant::Always()) << "now they touch in a point";
  EXPECT_EQ(RestsUntil(10), Instant::Always());
  b_ = Ball(2.25, -0.125);  // 0.125 m apart at 2 s, deep in each other at 10 s
  EXPECT_EQ(RestsUntil(10), Instant::Always());
}

TEST_F(ContactRestTest, NeedsACertainContactThatGoesOn) {
  preview_ = Ahead(lowerable_, {0, 0, 0.25, true, 0.5});
  EXPECT_EQ(RestsUntil(2), Instant::Always()) << "it has ended";
  preview_ = Ahead(lowerable_, {0.25, 0.5, 1, true, 1});
  EXPECT_EQ(RestsUntil(2), Instant::Always()) << "a first contact has ended, its end may move";
  lowerable_ = Tracked(Undecided());
  preview_ = Ahead(lowerable_, Undecided());
  EXPECT_EQ(RestsUntil(2), Instant::Always()) << "it is not certain";
}

// A contact that began after what is settled: later states may narrow its begin.
TEST_F(ContactRestTest, NeedsABeginThatIsSettled) {
  lowerable_ = Tracked({1, 1, 0, true, 0});
  preview_ = Ahead(lowerable_, {0.25, 0.5, 1, true, 1});
  EXPECT_EQ(RestsUntil(2), Instant::Always());
  lowerable_ = Tracked(Undecided());
  preview_ = Ahead(lowerable_, Touching());
  EXPECT_LE(RestsUntil(2), At(9));
  EXPECT_GE(RestsUntil(2), At(9 - 2e-9)) << "certain from the settled instant on";
}

TEST_F(ContactRestTest, IsForBallsWhoseStatesWereEvaluated) {
  b_.shape_awaited = true;
  EXPECT_EQ(RestsUntil(2), Instant::Always()) << "a shape may part before its ball does";
  b_.shape_awaited = false;
  b_.bound.state.stamp = At(2.5);
  EXPECT_EQ(RestsUntil(3), Instant::Always()) << "a state lies ahead of the evaluation";
  b_.bound.state.stamp = At(2);
  EXPECT_GT(RestsUntil(3), At(3));
}

}  // namespace
}  // namespace collision::detection
