// Goal:   each step of the evaluation of a segment keeps its claim: freedom ends before contact may
//         begin, contact is certain where it is reported, and both are nearly tight; the normal and
//         the nearest instant are those of the bodies.
// Method: cubes of side 1, a little turned aside from each other's edges, 4 m apart, that close at
//         10 m/s and pass through each other: they touch from 0.4 s to 0.6 s.
#include "collision_core/narrow_phase/contact/segment_evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/collision_core/narrow_phase/contact/segment_body.h"
#include "tests/support/meshes.h"

namespace collision::narrow_phase {
namespace {

constexpr double kBegin = 0.4, kEnd = 0.6, kDuration = 1;

class SegmentEvaluationTest : public testing::Test {
 protected:
  const std::shared_ptr<const shape::Shape> cube_ = shape::Shape::Build(Cube(0.5));
  const SegmentBody at_rest_{.shape = cube_},
      coming_{.shape = cube_, .p = {5, 0.3, 0.2}, .v = {-10, 0, 0}};
  const BodySegment a_ = at_rest_.Segment(), b_ = coming_.Segment();
  WorkBudget work_{10'000'000};
  SegmentEvaluation evaluation_{a_, b_, kDuration, &work_};
};

TEST_F(SegmentEvaluationTest, FreedomEndsJustBeforeTheContactFromEitherSide) {
  const double until = evaluation_.FreeFrom(0, TimeDirection::kForward);
  EXPECT_LE(until, kBegin);
  EXPECT_GE(until, kBegin - 1e-5);
  const double from = evaluation_.FreeFrom(kDuration, TimeDirection::kBackward);
  EXPECT_GE(from, kEnd);
  EXPECT_LE(from, kEnd + 1e-5);
  EXPECT_FALSE(evaluation_.exhausted());
}

TEST_F(SegmentEvaluationTest, ThoseThatPassBesideEachOtherAreFreeThroughout) {
  SegmentBody passing = coming_;
  passing.p.y() = 1.001;
  const BodySegment b = passing.Segment();
  SegmentEvaluation evaluation(a_, b, kDuration, &work_);
  EXPECT_EQ(evaluation.FreeFrom(0, TimeDirection::kForward), numeric::kInfinity);
  EXPECT_EQ(evaluation.FreeFrom(kDuration, TimeDirection::kBackward), -numeric::kInfinity);
}

TEST_F(SegmentEvaluationTest, ContactIsCertainWithinItsTimesAndNearlyAsLong) {
  SegmentResult times;
  const double until = evaluation_.FreeFrom(0, TimeDirection::kForward);
  const double from = evaluation_.FreeFrom(kDuration, TimeDirection::kBackward);
  evaluation_.FindContact(until, from, &times);
  ASSERT_LE(times.contact_from, times.contact_to);
  EXPECT_GE(times.contact_from, kBegin);
  EXPECT_LE(times.contact_to, kEnd);
  evaluation_.Sharpen(until, from, &times);
  EXPECT_GE(times.contact_from, kBegin);
  EXPECT_LE(times.contact_from, kBegin + 1e-4);
  EXPECT_LE(times.contact_to, kEnd);
  EXPECT_GE(times.contact_to, kEnd - 1e-2);
}

// As if it had been found only in the middle third, which is later than rounding explains.
TEST_F(SegmentEvaluationTest, AContactThatIsFoundLateIsSharpenedAtBothEnds) {
  const double until = evaluation_.FreeFrom(0, TimeDirection::kForward);
  const double from = evaluation_.FreeFrom(kDuration, TimeDirection::kBackward);
  SegmentResult times;
  times.contact_from = 0.47;
  times.contact_to = 0.53;
  evaluation_.Sharpen(until, from, &times);
  EXPECT_GE(times.contact_from, kBegin);
  EXPECT_LE(times.contact_from, kBegin + 1e-4);
  EXPECT_LE(times.contact_to, kEnd);
  EXPECT_GE(times.contact_to, kEnd - 1e-4);
}

TEST_F(SegmentEvaluationTest, WithoutContactNoneIsFound) {
  SegmentBody passing = coming_;
  passing.p.y() = 1.001;
  const BodySegment b = passing.Segment();
  SegmentEvaluation evaluation(a_, b, kDuration, &work_);
  SegmentResult times;
  evaluation.FindContact(kBegin, kEnd, &times);
  evaluation.Sharpen(kBegin, kEnd, &times);
  EXPECT_GT(times.contact_from, times.contact_to);
  EXPECT_TRUE(evaluation.nearest().has_value()) << "instants were evaluated";
}

TEST_F(SegmentEvaluationTest, TheNormalIsThatOfTheFacesThatMeet) {
  EXPECT_FALSE(evaluation_.Normal().known) << "nothing is known of an approach";
  evaluation_.FreeFrom(0, TimeDirection::kForward);
  const ContactNormal normal = evaluation_.Normal();
  ASSERT_TRUE(normal.known);
  EXPECT_TRUE(normal.is_good());
  const double off = std::acos(std::min(1.0, normal.normal.x()));
  EXPECT_LE(off, normal.error);
}

TEST_F(SegmentEvaluationTest, AnInstantIsEvaluatedOnlyIfNoneWas) {
  EXPECT_FALSE(evaluation_.nearest().has_value());
  EXPECT_THROW(evaluation_.NearestProximity(), CheckFailure);
  evaluation_.QueryOnce(0.3);
  ASSERT_TRUE(evaluation_.nearest().has_value());
  EXPECT_EQ(evaluation_.nearest()->at, 0.3);
  evaluation_.QueryOnce(0.35);
  EXPECT_EQ(evaluation_.nearest()->at, 0.3);
}

// The faces are 1 m apart at 0.3 s.
TEST_F(SegmentEvaluationTest, TheProximityContainsTheDistance) {
  evaluation_.QueryOnce(0.3);
  const Proximity proximity = evaluation_.NearestProximity();
  EXPECT_LE(proximity.separation.lower, 1);
  EXPECT_GE(proximity.separation.upper, 1 - 1e-12);
  EXPECT_LE(proximity.separation.width(), 0.5) << "as closely as a decision needs";
  EXPECT_GT(proximity.separation.lower, 0);
}

// What is unknown of the motion of either grows by ½ 2 t²: the gap of 4 m may be used up at t with
// 10 t + t² = 4.
TEST_F(SegmentEvaluationTest, UncertainMotionEndsFreedomEarlierAndConfirmsNoContactTooEarly) {
  SegmentBody uncertain = coming_;
  uncertain.M = 2;
  const BodySegment b = uncertain.Segment();
  SegmentEvaluation evaluation(a_, b, kDuration, &work_);
  const double possible = std::sqrt(25 + 4) - 5, certain = 5 - std::sqrt(25 - 4);
  const double until = evaluation.FreeFrom(0, TimeDirection::kForward);
  EXPECT_LE(until, possible);
  EXPECT_GE(until, possible - 1e-4);
  SegmentResult times;
  evaluation.FindContact(until, kDuration, &times);
  evaluation.Sharpen(until, kDuration, &times);
  ASSERT_LE(times.contact_from, times.contact_to);
  EXPECT_GE(times.contact_from, certain - 1e-12);
  EXPECT_LE(times.contact_from, certain + 0.05);
}

TEST_F(SegmentEvaluationTest, AnExhaustedBudgetClaimsNoMoreThanIsCertain) {
  WorkBudget little(20);
  SegmentEvaluation evaluation(a_, b_, kDuration, &little);
  const double until = evaluation.FreeFrom(0, TimeDirection::kForward);
  EXPECT_LE(until, kBegin);
  EXPECT_TRUE(evaluation.exhausted());
  SegmentResult times;
  evaluation.FindContact(until, kDuration, &times);
  if (times.contact_from <= times.contact_to) {
    EXPECT_GE(times.contact_from, kBegin);
    EXPECT_LE(times.contact_to, kEnd);
  }
  evaluation.QueryOnce(0.3);
  EXPECT_TRUE(evaluation.nearest().has_value()) << "whatever the budget";
}

}  // namespace
}  // namespace collision::narrow_phase
