// Directions between cores of which one is smooth, to the last bits.
#pragma once

#include "collision_core/shape/convex_search.h"

namespace collision {

/// The corners of a search's simplex crowd together where a smooth core is near, and what they tell
/// of the direction is off by as much as they are apart. From there on Newton's method: of the
/// directions n near `about` (across `edge`, unless that is zero) the one along which the cores'
/// shadows are the farthest apart, where the support point of B − A lies along n itself. The second
/// derivative of an ellipsoid's support function is known in closed form. Any length; a proposal,
/// like all directions.
Eigen::Vector3d WidestNear(const ConvexPair& pair, const Eigen::Vector3d& about,
                           const Eigen::Vector3d& edge);

/// Steps of Newton's method; from a simplex two or three reach rounding.
inline constexpr int kPolishSteps = 4;

}  // namespace collision
