// Goal:   the onset of a contact forward, and its end backward, lie between the last certain
//         freedom and the first certain contact, and the bracket is as narrow as asked for.
// Method: cubes of side 1, 4 m apart, that close at 10 m/s and pass through each other: they touch
//         from 0.4 s to 0.6 s.
#include "collision_core/narrow_phase/contact/contact_boundary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/collision_core/narrow_phase/contact/segment_body.h"
#include "tests/support/meshes.h"

namespace collision::narrow_phase {
namespace {

constexpr double kBegin = 0.4, kEnd = 0.6, kDuration = 1;
/// What rounding the states may move a time by.
constexpr double kStated = 1e-14;

class ContactBoundaryTest : public testing::Test {
 protected:
  ContactBoundary Towards(TimeDirection direction, const ShapeMotion& motion,
                          const ContactTolerance& tolerance = {}) {
    return {motion, kDuration, tolerance, direction, &work_};
  }
  static SegmentBody Coming(const Eigen::Vector3d& from, double half = 0.5) {
    return {.shape = shape::Shape::Build(Cube(half)), .p = from, .v = {-10, 0, 0}};
  }

  const BodySegment a_ = SegmentBody{.shape = shape::Shape::Build(Cube(0.5))}.Segment();
  const BodySegment b_ = Coming({5, 0.3, 0.2}).Segment();
  WorkBudget work_{50'000'000};
  const ShapeMotion motion_{a_, b_, &work_};
};

TEST_F(ContactBoundaryTest, ForwardTheBracketHoldsTheBegin) {
  ContactBoundary edge = Towards(TimeDirection::kForward, motion_);
  const double free = edge.FreeFrom(0);
  EXPECT_LE(free, kBegin + kStated);
  const std::optional<double> touching = edge.ContactAfter(free, kDuration);
  ASSERT_TRUE(touching.has_value());
  EXPECT_GE(*touching, kBegin - kStated);
  EXPECT_LE(*touching - free, 1e-12);
  EXPECT_FALSE(edge.exhausted() || edge.nested() || edge.uncertain());
  EXPECT_LE(edge.nearest(), 1e-10) << "an upper bound of the distance, where they touch";
}

TEST_F(ContactBoundaryTest, BackwardTheBracketHoldsTheEnd) {
  ContactBoundary edge = Towards(TimeDirection::kBackward, motion_);
  const double free = edge.FreeFrom(kDuration);
  EXPECT_GE(free, kEnd - kStated);
  const std::optional<double> touching = edge.ContactAfter(free, 0);
  ASSERT_TRUE(touching.has_value());
  EXPECT_LE(*touching, kEnd + kStated);
  EXPECT_LE(free - *touching, 1e-12);
}

TEST_F(ContactBoundaryTest, AToleranceThatIsWiderIsKept) {
  ContactBoundary edge = Towards(TimeDirection::kForward, motion_, {.absolute = 1e-3});
  const double free = edge.FreeFrom(0);
  EXPECT_LE(free, kBegin + kStated);
  EXPECT_GE(free, kBegin - 1e-3);
  const std::optional<double> touching = edge.ContactAfter(free, kDuration);
  ASSERT_TRUE(touching.has_value());
  EXPECT_GE(*touching, kBegin - kStated);
  EXPECT_LE(*touching - free, 1e-3);
}

TEST_F(ContactBoundaryTest, ThoseThatPassBesideEachOtherAreFreeAllTheWay) {
  const BodySegment b = Coming({5, 1.000001, 0}).Segment();
  const ShapeMotion motion(a_, b, &work_);
  EXPECT_EQ(Towards(TimeDirection::kForward, motion).FreeFrom(0), numeric::kInfinity);
  EXPECT_EQ(Towards(TimeDirection::kBackward, motion).FreeFrom(kDuration), -numeric::kInfinity);
}

TEST_F(ContactBoundaryTest, ContactAtTheStartBeginsThere) {
  const BodySegment b = Coming({0.75, 0.3, 0.2}).Segment();
  const ShapeMotion motion(a_, b, &work_);
  ContactBoundary edge = Towards(TimeDirection::kForward, motion);
  EXPECT_EQ(edge.FreeFrom(0), 0);
  EXPECT_EQ(edge.ContactAfter(0, kDuration), 0);
}

TEST_F(ContactBoundaryTest, NoContactIsFoundBeforeItIsPossible) {
  ContactBoundary edge = Towards(TimeDirection::kForward, motion_);
  edge.FreeFrom(0);
  EXPECT_EQ(edge.ContactAfter(0.2, 0.39), std::nullopt);
  EXPECT_EQ(edge.ContactByCandidates(0.2, 0.39), std::nullopt);
}

TEST_F(ContactBoundaryTest, CandidatesAloneFindTheSameBeginOrALaterOne) {
  ContactBoundary edge = Towards(TimeDirection::kForward, motion_);
  const double free = edge.FreeFrom(0);
  const std::optional<double> touching = edge.ContactByCandidates(free, kDuration);
  ASSERT_TRUE(touching.has_value());
  EXPECT_GE(*touching, kBegin - kStated);
  EXPECT_LE(*touching, kBegin + 1e-9);
}

TEST_F(ContactBoundaryTest, ContactLastsForSomeTimeAndNotBeyondItsEnd) {
  ContactBoundary edge = Towards(TimeDirection::kForward, motion_);
  const double free = edge.FreeFrom(0);
  const std::optional<double> touching = edge.ContactByCandidates(free, kDuration);
  ASSERT_TRUE(touching.has_value());
  const double lasts = edge.LastsFrom(*touching, kDuration);
  EXPECT_GT(lasts, kBegin + 0.01);
  EXPECT_LE(lasts, kEnd + kStated);
  EXPECT_EQ(edge.LastsFrom(*touching, kBegin + 0.005), kBegin + 0.005) << "and not beyond `until`";
}

// Half as fine steps would end it nearer.
TEST_F(ContactBoundaryTest, ACoarseAdvanceEndsWithinItsShortestStep) {
  constexpr double kStep = 1e-3;
  ContactBoundary edge =
      ContactBoundary::Coarse(motion_, kDuration, kStep, TimeDirection::kForward, &work_);
  const double free = edge.FreeFrom(0);
  EXPECT_LE(free, kBegin + kStated);
  EXPECT_GE(free, kBegin - kStep);
}

// A sheet drifts in the wall of a hollow cube. It has no inside, so that only a test of containment
// tells that it touches.
TEST_F(ContactBoundaryTest, ABodyInsideTheOtherIsNeverCertifiedFree) {
  const SegmentBody outer{.shape = shape::Shape::Build(HollowCube(5, 3))};
  const SegmentBody inner{
      .shape = shape::Shape::Build(Sheet(0.05, 1)), .p = {4, 0.2, 0.1}, .v = {0.125, 0, 0}};
  const BodySegment a = outer.Segment(), b = inner.Segment();
  const ShapeMotion motion(a, b, &work_);
  ContactBoundary edge = Towards(TimeDirection::kForward, motion);
  EXPECT_EQ(edge.FreeFrom(0), 0);
  EXPECT_TRUE(edge.nested());
  EXPECT_EQ(edge.ContactAfter(0, kDuration), 0);
}

// A rod turns by 2 rad to a ball beside its end: one sweep covers a part of that turn only.
TEST_F(ContactBoundaryTest, ATurnIsFollowedSweepAfterSweep) {
  const double angle = 2, rate = 2;
  const SegmentBody rod{.shape = shape::Shape::Build(Rod(2, 0.1)), .w = {0, 0, rate}};
  const SegmentBody ball{.p = {1.5 * std::cos(angle), 1.5 * std::sin(angle), 0}, .radius = 0.1};
  const BodySegment a = rod.Segment(), b = ball.Segment();
  const ShapeMotion motion(a, b, &work_);
  ContactBoundary edge = Towards(TimeDirection::kForward, motion);
  const double begin = (angle - std::asin(0.2 / 1.5)) / rate;
  const double free = edge.FreeFrom(0);
  EXPECT_LE(free, begin + kStated);
  EXPECT_GE(free, begin - 1e-9);
}

TEST_F(ContactBoundaryTest, WhereAnOrientationIsUnknownTheBoundarySaysSo) {
  SegmentBody turning = Coming({5, 0, 0});
  turning.alpha = -1;
  const BodySegment b = turning.Segment();
  const ShapeMotion motion(a_, b, &work_);
  ContactBoundary edge = Towards(TimeDirection::kForward, motion);
  const double free = edge.FreeFrom(0);
  EXPECT_LE(free, kBegin);
  EXPECT_GT(free, 0.3) << "the ball of the body ends at √3 / 2";
  EXPECT_TRUE(edge.orientation_unknown());
  ContactBoundary known = Towards(TimeDirection::kForward, motion_);
  known.FreeFrom(0);
  EXPECT_FALSE(known.orientation_unknown());
}

TEST_F(ContactBoundaryTest, AnUncertainMotionIsToldAndBracketsTheBeginMoreWidely) {
  SegmentBody uncertain = Coming({5, 0.3, 0.2});
  uncertain.M = 2;
  const BodySegment b = uncertain.Segment();
  const ShapeMotion motion(a_, b, &work_);
  ContactBoundary edge = Towards(TimeDirection::kForward, motion);
  const double free = edge.FreeFrom(0);
  const double possible = std::sqrt(25 + 4) - 5, certain = 5 - std::sqrt(25 - 4);
  EXPECT_LE(free, possible + kStated);
  EXPECT_GE(free, possible - 1e-6);
  const std::optional<double> touching = edge.ContactAfter(free, kDuration);
  ASSERT_TRUE(touching.has_value());
  EXPECT_GE(*touching, certain - kStated);
  EXPECT_LE(*touching, certain + 1e-2);
  EXPECT_TRUE(edge.uncertain());
}

TEST_F(ContactBoundaryTest, AnExhaustedBudgetIsToldAndClaimsNothingFalse) {
  WorkBudget little(30);
  const ShapeMotion motion(a_, b_, &little);
  ContactBoundary edge(motion, kDuration, {}, TimeDirection::kForward, &little);
  const double free = edge.FreeFrom(0);
  EXPECT_LE(free, kBegin + kStated);
  const std::optional<double> touching = edge.ContactAfter(free, kDuration);
  EXPECT_TRUE(edge.exhausted());
  if (touching) {
    EXPECT_GE(*touching, kBegin - kStated);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
