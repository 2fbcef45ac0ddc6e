// How far a point is from a triangle, certified.
#pragma once

#include <array>

#include "collision_core/numeric/interval.h"

namespace collision::geometry {

/// The three corners of a triangle [m].
using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// The distance of a point to a triangle.
struct PointTriangleDistance {
  numeric::Interval distance;  ///< Contains the exact distance.
  Eigen::Vector3d nearest;     ///< The nearest point of the triangle, approximately.
};

/// The distance of a point to a triangle whose corners are exactly as given. Width: a few units in
/// the last place of the coordinates, also for slivers; a triangle without area is its longest
/// side.
PointTriangleDistance DistanceToTriangle(const Eigen::Vector3d& point,
                                         const TrianglePoints& corners);

/// Whether the triangle is certainly farther than `distance`: a fast test in plain doubles that
/// returns false where rounding might decide.
bool IsCertainlyFarther(const Eigen::Vector3d& point, const TrianglePoints& corners,
                        double distance);

}  // namespace collision::geometry
