// Directions between cores of which one is smooth, to the last bits.
#pragma once

#include "collision_core/geometry/convex/gjk.h"

namespace collision::geometry {

/// Of the directions n near `about` (across `edge`, unless that is zero) the one along which the
/// cores' shadows are the farthest apart, where the support point of B − A lies along n itself. Any
/// length; a proposal, like all directions.
///
/// Where the two cores nearly touch, the corners of a search's simplex crowd together, and the
/// direction they give is off by as much as they are apart (1e-4 for a gap of 1e-8 of the size).
/// From there on Newton's method is taken, across each edge that the search ended at, with the
/// second derivative of the ellipsoid's support function in closed form. Two steps reach the last
/// bits: 1e-13 m for solids of 1 m, however near.
Eigen::Vector3d WidestNear(const ConvexPair& pair, const Eigen::Vector3d& about,
                           const Eigen::Vector3d& edge);

/// Steps of Newton's method; from a simplex two or three reach rounding.
inline constexpr int kPolishSteps = 4;

}  // namespace collision::geometry
