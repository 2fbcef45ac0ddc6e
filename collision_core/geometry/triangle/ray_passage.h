// How a line along x passes a triangle, exactly.
#pragma once

#include "collision_core/geometry/triangle/point_triangle.h"

namespace collision::geometry {

/// kUnknown: the point lies on the triangle, or too near to its rim to tell.
enum class Passing { kAside, kBackward, kForward, kUnknown };

/// The line through a point along x, moved by infinitely little along +y and by infinitely less
/// along +z: it meets no edge.
struct RayPassage {
  Passing passing = Passing::kAside;
  int sign = 0;  ///< 1: along +x it leaves through the triangle's back, into what is outside.
};

RayPassage PassageOf(const TriangleCorners& triangle, const Eigen::Vector3d& point);

}  // namespace collision::geometry
