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

}  // namespace collision::narrow_phase
