// How a line along x passes a triangle, exactly.
#pragma once

#include "collision_core/geometry/triangle/point_triangle.h"

namespace collision::geometry {

/// Where a line through a point passes a triangle: not at all (kAside), behind the point
/// (kBackward) or ahead of it (kForward). kUnknown: the point lies on the triangle, or too near to
/// its rim to tell.
enum class Passing { kAside, kBackward, kForward, kUnknown };

/// How the line through a point along x passes a triangle. The line is moved by infinitely little
/// along +y and by infinitely less along +z, so it meets no edge.
struct RayPassage {
  Passing passing = Passing::kAside;
  /// 1: along +x the line leaves the solid here, from the triangle's back to its front; −1: it
  /// enters.
  int sign = 0;
};

RayPassage PassageOf(const TrianglePoints& triangle, const Eigen::Vector3d& point);

}  // namespace collision::geometry
