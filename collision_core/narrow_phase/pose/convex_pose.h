// Convex sets where a body is, at an instant.
#pragma once

#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/shape/convex_solid.h"

namespace collision::narrow_phase {

/// A set of B in A's body frame. Its `error` includes rounding and the uncertain turning of B, not
/// the pose's `translation`.
geometry::ConvexSet PosedB(const geometry::ConvexSet& of_b, const RelativePose& pose);

/// A set of A in its own frame. Its `error` includes the uncertain turning of A and nothing else.
geometry::ConvexSet PosedA(const geometry::ConvexSet& of_a, const RelativePose& pose);

/// A half-space of B in A's body frame.
struct PosedHalfSpace {
  Eigen::Vector3d normal;  ///< Unit to within 2^-40.
  Eigen::Vector3d point;
  double point_error = 0;  ///< The point is within this of the exact one [m].
  /// The exact normal differs by a vector no longer than this.
  double normal_error = 0;
};
PosedHalfSpace PosedA(const shape::ConvexHalfSpace& of_a, const RelativePose& pose);
PosedHalfSpace PosedB(const shape::ConvexHalfSpace& of_b, const RelativePose& pose);

}  // namespace collision::narrow_phase
