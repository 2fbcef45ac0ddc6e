// Free, touching or undecided: two bodies of which at least one has a shape, over one segment of
// time.
//
// Conservative advancement. From a certified gap at one instant nothing touches before the gap is
// used up by the greatest relative speed of any two points, including the growth of the
// uncertainties. From certain contact by a margin, contact lasts until the margin is used up. So
// contacts that begin and end within the segment are found, freedom is certified for all of it from
// both ends, and contact for an interval, not for samples.
//
// The normal is that of an instant before contact at which the gap is many times what is uncertain:
// there the shortest way between the two is known. Where they may touch at once it is that of the
// last state before, unless a jump lies between or the shape was another one. All ways that may be
// the shortest are kept, and the error covers them all and what the uncertainty can turn them by
// (derived in contact_proximity.cc). Bodies that overlap have no shortest way; without an approach
// that was seen, the normal is a guess along the centres and its error says so (π).
//
// Budgets. With more work a query, a bracket of some width and a refinement take the same steps,
// only more of them: their brackets never become wider, and a decision that was made stays.
// EvaluateShapeSegment() and TimeOfContact() do not promise that: each of their parts has a share
// of the budget, and where one ends the next begins, so that with a little more one end of a
// bracket may be found later. It holds all the same.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/contact/ball_contact.h"
#include "collision_core/narrow_phase/contact/contact_normal.h"
#include "collision_core/narrow_phase/pose/body_segment.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::narrow_phase {

/// What is known of two bodies over a segment, when they are nearest, and how they approach.
struct ShapeSegmentResult {
  SegmentResult times;
  ContactNormal normal;    ///< From the last instant before `times.free_until` with a good normal.
  bool exhausted = false;  ///< The work ended before everything was examined.
  /// The instant, of those examined, with the least upper bound of the distance.
  bool examined = false;  ///< An instant was examined: `nearest_at` and `nearest` are set.
  double nearest_at = 0;
  Proximity nearest;
};

/// Evaluates [0, duration] within what the balls leave open (`balls`: the result for the two
/// balls). Conservative advancement as described at the head of this file. Requires that neither is
/// awaited.
ShapeSegmentResult EvaluateShapeSegment(const BodySegment& a, const BodySegment& b, double duration,
                                        const SegmentResult& balls, WorkBudget* work);

/// How far from `from` on the two stay apart for certain, up to `duration`; `from` itself if they
/// may touch at once. +infinity: throughout, the end included. Like the others below it requires
/// that one of the two has a shape and neither is awaited.
double FreeAhead(const BodySegment& a, const BodySegment& b, double from, double duration,
                 WorkBudget* work);

/// The direction of the shortest way between the two at δ, where they are apart.
ContactNormal NormalAt(const BodySegment& a, const BodySegment& b, double delta, WorkBudget* work);

/// The distance, point and normal at δ.
Proximity ShapeProximity(const BodySegment& a, const BodySegment& b, double delta,
                         WorkBudget* work);

}  // namespace collision::narrow_phase
