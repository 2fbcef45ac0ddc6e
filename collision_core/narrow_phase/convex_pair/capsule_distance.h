// The distance of a ball or a capsule to a ball, a capsule or a box: in closed form.
#pragma once

#include "collision_core/geometry/convex/convex_set.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/numeric/interval.h"

namespace collision::narrow_phase {

/// Two cores at a pose, their centres subtracted first. Each set is given in its own body's frame.
struct PosedCores {
  PosedCores(const geometry::ConvexSet& a, const geometry::ConvexSet& b, const RelativePose& pose);

  Eigen::Vector3d d;  ///< From A's centre to B's: off by 2^-53 |d| from what is posed.
  double size;        ///< S: at least |d| + span_A + (1 + 2^-20) span_B.
  double error;       ///< The sets meant are within this of what is posed, both together.
};

/// Whether DistanceOfCores() has a closed form for the two.
inline bool IsCapsulePair(const geometry::ConvexSet& a, const geometry::ConvexSet& b) {
  return (a.IsThin() && (b.IsThin() || b.core == geometry::ConvexCore::kBox)) ||
         (b.IsThin() && a.core == geometry::ConvexCore::kBox);
}

/// The bracket of the distance of the two posed cores. Where they meet, the lower end is −infinity
/// and the upper end exceeds 0 by rounding only. Each set is given in its own body's frame.
/// Requires IsCapsulePair(a, b).
numeric::Interval DistanceOfCores(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                                  const PosedCores& cores, const RelativePose& pose);

}  // namespace collision::narrow_phase
