// Newton's method for the direction between two cores of which at least one is smooth.
#pragma once

#include "collision_core/geometry/convex/gjk.h"

namespace collision::geometry {

/// Returns the direction near `about` along which the cores' projections are the farthest apart:
/// there the support point of B − A lies along the direction itself. Unless `edge` is zero, only
/// directions perpendicular to it are tried. The result has any length; it is a proposal that the
/// caller certifies.
///
/// Where the two cores nearly touch, the corners of GJK's last simplex lie close together, and the
/// direction that they give is inaccurate (off by 1e-4 for a gap of 1e-8 of the size). Newton's
/// method improves it, perpendicular to the edge at which the search ended if there is one, with
/// the second derivative of the ellipsoid's support function in closed form. Two steps reach the
/// last bits: 1e-13 m for solids of 1 m, however near.
Eigen::Vector3d WidestNear(const ConvexPair& pair, const Eigen::Vector3d& about,
                           const Eigen::Vector3d& edge);

/// Steps of Newton's method; from a simplex two or three reach rounding.
inline constexpr int kPolishSteps = 4;

}  // namespace collision::geometry
