// Convex sets where a body is, at an instant.
#pragma once

#include "collision_core/narrow_phase/relative_pose.h"
#include "collision_core/shape/convex_solid.h"

namespace collision {

/// A set of B in A's body frame. What rounding and the turning of B may make of it is counted into
/// its `error`; `translation` of the pose is not.
ConvexSet PosedB(const ConvexSet& of_B, const RelativePose& pose);

/// A set of A in its own frame: its turning is counted in, nothing else.
ConvexSet PosedA(const ConvexSet& of_A, const RelativePose& pose);

/// A half-space of B in A's body frame.
struct PosedHalfSpace {
  Eigen::Vector3d normal;  ///< Unit to within 2^-40.
  Eigen::Vector3d point;
  double point_error = 0;  ///< Of the point [m].
  double normal_error =
      0;  ///< Of the normal: the exact one differs by a vector no longer than this.
};
PosedHalfSpace PosedA(const ConvexHalfSpace& of_A, const RelativePose& pose);
PosedHalfSpace PosedB(const ConvexHalfSpace& of_B, const RelativePose& pose);

}  // namespace collision
