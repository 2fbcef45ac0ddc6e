// How far a point is from a triangle, certified.
#pragma once

#include <array>

#include "collision_core/numeric/interval.h"

namespace collision::geometry {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

struct PointTriangleDistance {
  numeric::Interval distance;  ///< Contains the exact distance.
  Eigen::Vector3d nearest;     ///< About the nearest point of the triangle.
};

/// The distance of a point to a triangle whose corners are exactly as given. Width: a few units in
/// the last place of the coordinates, also for slivers; a triangle without area is its longest
/// side.
PointTriangleDistance DistanceToTriangle(const Eigen::Vector3d& point,
                                         const TriangleCorners& corners);

/// Whether the triangle is certainly farther than `distance`: fast, and right where it says yes;
/// says no where it is not sure.
bool IsCertainlyFarther(const Eigen::Vector3d& point, const TriangleCorners& corners,
                        double distance);

}  // namespace collision::geometry
