// Two convex sets: how far apart or how deep in each other, certified.
//
// A search proposes (convex_search.h), facts certify (convex_bracket.h). Overlapping shadows give
// the shift that takes the two apart, so one number with a sign serves distance and depth. Boxes,
// capsules, hulls and triangles are known to about 64 · 2^-53 of their size. A half-space needs no
// search. A search may begin where an earlier one ended: then one step confirms it.
#pragma once

#include <numbers>

#include "collision_core/base/work_budget.h"
#include "collision_core/geometry/convex/gjk.h"
#include "collision_core/narrow_phase/convex_pair/convex_question.h"
#include "collision_core/narrow_phase/pose/convex_pose.h"
#include "collision_core/numeric/interval.h"

namespace collision::narrow_phase {

/// The certified answer.
struct ConvexSeparation {
  /// Contains the distance of the two where they are apart; where they overlap, less the
  /// translational penetration depth: no shift by less than −upper takes them apart, one by −lower
  /// (along the normal) does.
  numeric::Interval separation{-numeric::kInfinity, numeric::kInfinity};
  /// Points of the two, to within `point_error`: apart no further than separation.upper; in contact
  /// (upper <= 0) the same point twice, and one common to both is that near.
  Eigen::Vector3d a{0, 0, 0}, b{0, 0, 0};
  double point_error = numeric::kInfinity;
  /// Unit, from A to B: along the shortest way between them, or of the cores if their roundings
  /// overlap; within `normal_error` [rad]. π: the shortest shift that is known takes B that way.
  Eigen::Vector3d normal{0, 0, 0};
  double normal_error = std::numbers::pi;
  bool exhausted = false;  ///< A limit on steps or on work ended the search.
};

/// Both in one frame. Rounding is relative to the size S of the pair (gjk.h) and not to
/// their place: polytopes are known to about 64 · 2^-53 S and what their `error`s are. What is
/// smooth may use up its steps (kGjkStepsMax, kEpaStepsMax); then the bracket stays wider.
/// The limits and the work allowed end the search, at whatever bracket it has by then.
ConvexSeparation SeparationOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                              const ConvexQuestion& question, geometry::GjkHint* hint,
                              WorkBudget* work);

/// Only `separation` of the same question; faster.
numeric::Interval IntervalOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                             const ConvexQuestion& question, WorkBudget* work);

/// A convex set and a half-space, exact but for rounding: B is the half-space. To take the two
/// apart a shift along its normal is the shortest.
ConvexSeparation SeparationOf(const geometry::ConvexSet& a, const PosedHalfSpace& b);

}  // namespace collision::narrow_phase
