// Goal:   advances through time by sweeps go as far as they can and no further: along turns, to and
//         from the middle between two states, over segments of no duration, and for solids inside
//         of one another.
// Method: contacts whose times are known exactly.
#include "collision_core/narrow_phase/contact/shape_motion.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/contact/shape_contact.h"
#include "tests/collision_core/narrow_phase/contact/segment_body.h"
#include "tests/support/meshes.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint64_t kPlenty = 10'000'000;
using Body = SegmentBody;

SegmentResult Judged(const BodySegment& a, const BodySegment& b, double duration) {
  WorkBudget work(kPlenty);
  return EvaluateShapeSegment(a, b, duration, EvaluateBallSegment(a.ball, b.ball, duration), &work)
      .times;
}

double Ahead(const BodySegment& a, const BodySegment& b, double duration) {
  WorkBudget work(kPlenty);
  return FreeAhead(a, b, 0, duration, &work);
}

// A rod turns about z towards a ball of 0.1 m at 1.5 m from its middle, and past it were it not
// there: its side reaches the ball where the two directions are asin(0.2 / 1.5) apart, before and
// after.
TEST(ShapeMotion, TurnsAreFollowedToTheContactFromBothSides) {
  const auto rod = shape::Shape::Build(Rod(2, 0.1));
  const double half = std::asin(0.2 / 1.5);
  for (const double at : {0.3, 1.0, 2.0, 2.7}) {
    for (const double rate : {1.0, -1.0, 4.0}) {
      const double angle = rate * at;
      if (std::abs(angle) > 2.9) continue;  // the other end comes first
      const Body turning{.shape = rod, .w = {0, 0, rate}};
      const Body ball{
          .shape = nullptr, .p = {1.5 * std::cos(angle), 1.5 * std::sin(angle), 0}, .radius = 0.1};
      const double begin = at - half / std::abs(rate), end = at + half / std::abs(rate);
      const double duration = at + 0.2;
      for (const bool swapped : {false, true}) {
        const BodySegment a = (swapped ? ball : turning).Segment(duration);
        const BodySegment b = (swapped ? turning : ball).Segment(duration);
        const SegmentResult times = Judged(a, b, duration);
        EXPECT_LE(times.free_until, begin);
        EXPECT_GE(times.free_until, begin - 1e-4) << at << " " << rate;
        EXPECT_LE(times.contact_from, begin + 1e-3);
        EXPECT_GE(times.contact_from, begin);
        const double ahead = Ahead(a, b, duration);
        EXPECT_LE(ahead, begin);
        EXPECT_GE(ahead, begin - 1e-4);
        if (end > duration) continue;
        EXPECT_GE(times.free_from, end);
        EXPECT_LE(times.free_from, end + 1e-4) << at << " " << rate;
      }
    }
  }
}

// In T = 1 s a body of 1 m/s² leaves what one state says by at most 0.5 m, what two say by at most
// 0.125 m.
TEST(ShapeMotion, EachHalfBetweenTwoStatesByTheNearerOne) {
  const auto cube = shape::Shape::Build(Cube(1));
  for (const double gap : {0.26, 0.24}) {
    const Body a{.shape = cube, .M = 1}, b{.shape = cube, .p = {2 + gap, 0.3, 0.1}, .M = 1};
    const SegmentResult both = Judged(a.Segment(1), b.Segment(1), 1);
    const SegmentResult forward = Judged(a.Segment({}), b.Segment({}), 1);
    const SegmentResult backward = Judged(a.Segment(1, false), b.Segment(1, false), 1);
    EXPECT_NEAR(forward.free_until, std::sqrt(gap), 1e-5);
    EXPECT_NEAR(backward.free_from, 1 - std::sqrt(gap), 1e-5);
    EXPECT_LE(forward.free_until, std::sqrt(gap));
    EXPECT_GE(backward.free_from, 1 - std::sqrt(gap));
    if (gap > 0.25) {
      EXPECT_EQ(both.free_until, numeric::kInfinity);
    } else {
      EXPECT_LE(both.free_until, std::sqrt(gap));
      EXPECT_GE(both.free_from, 1 - std::sqrt(gap));
    }
  }
}

// Away from the state at 1 s, from half-way on: what is not known grows although time runs
// backward, and faster than at the state.
TEST(ShapeMotion, BackwardFromHalfWayTheUncertaintyGrows) {
  const auto swept = [](const Body& a, const Body& b) {
    WorkBudget work(kPlenty);
    const BodySegment of_a = a.Segment(1, false), of_b = b.Segment(1, false);
    return ShapeMotion(of_a, of_b, &work)
        .SweepFrom(0.5, 0.5, TimeDirection::kBackward)
        .touch.seconds;
  };
  // Both together (1 − δ)²: 0.49 m at 0.3 s.
  const auto cube = shape::Shape::Build(Cube(1));
  const double moved = swept({.shape = cube, .p = {0, 0, 0}, .M = 1},
                             {.shape = cube, .p = {2.49, 0.3, 0.1}, .M = 1});
  EXPECT_LE(moved, 0.2);
  EXPECT_GE(moved, 0.2 - 1e-6);
  // Turned by ½ (1 − δ)² a rod's side reaches a ball of 0.1 m beside it at 0.3 rad.
  const double y = (0.2 + 1.5 * std::sin(0.3)) / std::cos(0.3);
  const double turned =
      swept({.shape = shape::Shape::Build(Rod(2, 0.1)), .p = {0, 0, 0}, .alpha = 1},
            {.shape = nullptr, .p = {1.5, y, 0}, .radius = 0.1});
  EXPECT_LE(turned, 0.5 - (1 - std::sqrt(0.6)));
  EXPECT_GE(turned, 0.1);
}

TEST(ShapeMotion, AnInstantIsJudgedInsideAndOut) {
  const Body great{.shape = shape::Shape::Build(Cube(5))};
  const auto small = shape::Shape::Build(Cube(0.5));
  for (const double duration : {0.0, 1e-9, 1.0}) {
    const auto judged = [&](double x) {
      const Body body{.shape = small, .p = {x, 0.2, 0.1}};
      return Judged(great.Segment({}), body.Segment({}), duration);
    };
    const SegmentResult inside = judged(1);
    EXPECT_LE(inside.free_until, 0) << duration;
    EXPECT_EQ(inside.contact_from, 0);
    EXPECT_EQ(inside.contact_to, duration);
    EXPECT_GE(inside.free_from, duration);
    EXPECT_EQ(judged(6).free_until, numeric::kInfinity);
    const SegmentResult across = judged(5.2);
    EXPECT_LE(across.free_until, 0);
    EXPECT_EQ(across.contact_to, duration);
  }
}

TEST(ShapeMotion, InsideAnotherNothingIsFreeAhead) {
  const Body great{.shape = shape::Shape::Build(Cube(5))};
  const Body within{.shape = shape::Shape::Build(Cube(0.5)), .p = {1, 0.2, 0.1}};
  const Body hollow{.shape = shape::Shape::Build(HollowCube(5, 3))};
  EXPECT_EQ(Ahead(great.Segment({}), within.Segment({}), 1), 0);
  EXPECT_EQ(Ahead(within.Segment({}), great.Segment({}), 1), 0);
  EXPECT_EQ(Ahead(hollow.Segment({}), within.Segment({}), 1), numeric::kInfinity);
}

// Where the balls are apart throughout, seen from the end, the shapes are.
TEST(ShapeMotion, WhatTheBallsExcludeFromOneSideOnly) {
  const Body a{.shape = shape::Shape::Build(Cube(1))}, b{.shape = a.shape, .p = {3.3, 0, 0}};
  SegmentResult balls;
  balls.free_until = 0.5;
  balls.free_from = -numeric::kInfinity;
  WorkBudget work(0);  // nothing may be tested
  const SegmentResult times =
      EvaluateShapeSegment(a.Segment({}), b.Segment({}), 1, balls, &work).times;
  EXPECT_EQ(times.free_until, numeric::kInfinity);
  EXPECT_EQ(times.free_from, -numeric::kInfinity);
}

}  // namespace
}  // namespace collision::narrow_phase
