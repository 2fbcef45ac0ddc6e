// Two convex sets: how far apart or how deep in each other, certified.
//
// A search proposes (convex_search.h), facts certify (convex_bracket.h). Overlapping projections
// give the shift that takes the two apart, so one number with a sign serves distance and depth.
// Boxes, capsules, hulls and triangles are known to about 64 · 2^-53 of their size. A search may
// begin where an earlier one ended: then one step confirms it.
#pragma once

#include <numbers>

#include "collision_core/base/work_budget.h"
#include "collision_core/geometry/convex/gjk.h"
#include "collision_core/narrow_phase/convex_pair/convex_query.h"
#include "collision_core/narrow_phase/pose/convex_pose.h"
#include "collision_core/numeric/interval.h"

namespace collision::narrow_phase {

/// The certified answer.
struct ConvexSeparation {
  /// Contains the distance of the two where they are apart; where they overlap, less the
  /// translational penetration depth: no shift by less than −upper takes them apart, one by −lower
  /// (along the normal) does.
  numeric::Interval separation{-numeric::kInfinity, numeric::kInfinity};
  /// Apart: the nearest points found, each within `point_error` of its set. In contact (upper <=
  /// 0): a == b, within `point_error` of a point common to both.
  Eigen::Vector3d a{0, 0, 0}, b{0, 0, 0};
  double point_error = numeric::kInfinity;
  /// Unit, from A to B, along the shortest way between the cores, which is that between the sets
  /// where they are apart; within `normal_error` [rad]. π: not certified; then the direction of the
  /// shortest shift found.
  Eigen::Vector3d normal{0, 0, 0};
  double normal_error = std::numbers::pi;
  bool exhausted = false;  ///< A limit on steps or on work ended the search.
};

/// The certified distance or depth of two sets given in one frame. Rounding is relative to the size
/// S of the pair (gjk.h), not to its place: the bracket of two polytopes is about 64 · 2^-53 S
/// wide, plus their `error`s. Smooth sets may use up their steps (kGjkStepsMax, kEpaStepsMax) or
/// the work allowed; then the search ends with the bracket that it has.
ConvexSeparation SeparationOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                              const ConvexQuery& query, geometry::GjkHint* hint, WorkBudget* work);

/// Only ConvexSeparation::separation of the same query; faster.
numeric::Interval IntervalOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                             const ConvexQuery& query, WorkBudget* work);

}  // namespace collision::narrow_phase
