// When two moving bodies are nearest, and how near: for all motions within what is known of them.
//
// Branch and bound. Every instant that is examined bounds the least distance from above, for every
// motion within the bounds. Over a span of time it is bounded from below; spans whose lower bound
// lies above the least upper bound cannot contain the nearest instant, and are dropped. The span
// with the least lower bound is halved next. So the answer is certain whenever the search ends, and
// only its width depends on the work.
//
// Two balls. With n the direction between the centres at the middle of a span, x seconds from it
// and |x| <= h
//
//   |d(x)| >= n·d(x) = n·d + (n·v) x + (n·b) x² >= n·d − |n·v| h − max(0, −n·b) h²,
//
// where b is half the relative acceleration. Near the closest approach n·v vanishes, so that a span
// half as long has a bound four times as good. The reach, radii and what is not known, is greatest
// at one of the ends, since it is convex.
//
// Shapes. ShapeMotion::DistanceOver(): no two points approach each other faster than the greatest
// relative speed. That bound is only twice as good for a span half as long, so a few per cent of
// the distance are reached, not its last digits. Overlapping bodies are bounded by their balls.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/body_segment.h"

namespace collision::narrow_phase {

/// What is asked.
struct ApproachQuery {
  double duration = 0;  ///< [s], from the base of the segments.
  /// Times at which they are certainly farther apart [m] are not searched.
  double beyond = numeric::kInfinity;
  /// Other segments come before and after: where the two are nearest at an end, those tell more,
  /// and the time is not narrowed down.
  bool continued = false;
};

/// What is certain of the least distance over a segment of time.
struct ClosestApproach {
  /// They are nearest within it: seconds after the base of the segments.
  numeric::Interval at;
  /// The least distance of the surfaces [m], as Proximity::separation. upper <= 0: they touch, and
  /// for shapes `lower` is then only as deep as their balls may overlap.
  numeric::Interval distance{-numeric::kInfinity, numeric::kInfinity};
};

/// The closest approach of two bodies. If they are farther apart than query.beyond all the time,
/// distance.lower > query.beyond; else `at` contains the times at which they may be nearer than
/// that and nearest. Of an awaited shape only the ball is known: nothing bounds the distance from
/// above. It ends where the distance is known about as well as the motion allows, or the work is
/// spent.
ClosestApproach FindClosestApproach(const BodySegment& a, const BodySegment& b,
                                    const ApproachQuery& query, WorkBudget* work);

}  // namespace collision::narrow_phase
