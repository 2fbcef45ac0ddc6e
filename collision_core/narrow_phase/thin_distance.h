// A ball or a capsule beside a ball, a capsule or a box: in closed form.
#pragma once

#include "collision_core/narrow_phase/relative_pose.h"
#include "collision_core/shape/convex_set.h"

namespace collision {

/// Two cores at a pose, their centres subtracted first.
struct PosedCores {
  PosedCores(const ConvexSet& of_A, const ConvexSet& of_B, const RelativePose& pose);

  Eigen::Vector3d d;  ///< From A's centre to B's: off by 2^-53 |d| from what is posed.
  double size;        ///< S: at least |d| + span_A + (1 + 2^-20) span_B.
  double error;       ///< The sets meant are within this of what is posed, both together.
};

/// Whether DistanceOfCores() knows the two.
inline bool IsThinPair(const ConvexSet& a, const ConvexSet& b) {
  return (a.IsThin() && (b.IsThin() || b.core == ConvexCore::kBox)) ||
         (b.IsThin() && a.core == ConvexCore::kBox);
}

/// The distance of the two cores, as they are posed; below 0, and wide, where they meet.
/// Requires IsThinPair().
Interval DistanceOfCores(const ConvexSet& of_A, const ConvexSet& of_B, const PosedCores& cores,
                         const RelativePose& pose);

}  // namespace collision
