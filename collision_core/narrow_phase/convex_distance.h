// Two convex sets: how far apart or how deep in each other, certified.
#pragma once

#include <numbers>

#include "collision_core/narrow_phase/convex_pose.h"
#include "collision_core/narrow_phase/work.h"
#include "collision_core/shape/convex_search.h"

namespace collision {

/// Units of work for a step of a search: a pair of support points; in a growing polytope, more.
inline constexpr std::uint64_t kConvexStepUnits = 1;
inline constexpr std::uint64_t kPolytopeStepUnits = 4;
inline constexpr std::uint64_t kFacesUnits = 4;  ///< All pairs of edges of two boxes.

enum class ConvexGoal {
  kYesNo,     ///< Certainly apart, or certainly in contact, and nothing more.
  kDistance,  ///< The distance; where they overlap, that they do.
  kDepth      ///< Likewise, and how deep they overlap.
};

struct ConvexQuestion {
  ConvexGoal goal = ConvexGoal::kDepth;
  double share = 0;  ///< A bracket this narrow relative to its lower end is narrow enough,
  double width = 0;  ///< or this narrow [m]. Both 0: as narrow as doubles make it.
};

struct ConvexSeparation {
  /// Contains the distance of the two where they are apart; where they overlap, less the
  /// translational penetration depth: no shift by less than −upper takes them apart, one by −lower
  /// (along the normal) does.
  Interval separation{-kInfinity, kInfinity};
  /// Points of the two, to within `point_error`: apart no further than separation.upper; in contact
  /// (upper <= 0) the same point twice, and one common to both is that near.
  Eigen::Vector3d a{0, 0, 0}, b{0, 0, 0};
  double point_error = kInfinity;
  /// Unit, from A to B: along the shortest way between them, or of the cores if their roundings
  /// overlap; within `normal_error` [rad]. π: the shortest shift that is known takes B that way.
  Eigen::Vector3d normal{0, 0, 0};
  double normal_error = std::numbers::pi;
  bool exhausted = false;  ///< A limit on steps or on work ended the search.
};

/// Both in one frame. Rounding is relative to the size S of the pair (convex_search.h) and not to
/// their place: polytopes are known to about 64 · 2^-53 S and what their `error`s are. What is
/// smooth may use up its steps (kSearchStepsMax, kPolytopeStepsMax); then the bracket stays wider.
/// The limits and the work allowed end the search, at whatever bracket it has by then.
ConvexSeparation SeparationOf(const ConvexSet& a, const ConvexSet& b,
                              const ConvexQuestion& question, SearchHint* hint, Work* work);

/// `separation` and nothing else.
Interval IntervalOf(const ConvexSet& a, const ConvexSet& b, const ConvexQuestion& question,
                    Work* work);

/// A convex set and a half-space, exact but for rounding: B is the half-space. To take the two
/// apart a shift along its normal is the shortest.
ConvexSeparation SeparationOf(const ConvexSet& a, const PosedHalfSpace& b);

}  // namespace collision
