// A convex solid as the checker sees it: a core of triangles, and how far around it belongs to it.
#pragma once

#include <array>
#include <vector>

#include "client/simulators/checker/mesh.h"

namespace collision::checker {

/// Points of one hull at most: finding its faces looks at every four of them.
inline constexpr std::size_t kHullPointsMax = 64;

/// All points within `rounding_m` of the core: a ball's is a point, a capsule's a segment, a box's
/// or a hull's is closed. In the axes of its body, about the reference point [m].
struct Solid {
  Mesh core;
  double rounding_m = 0;

  double radius_m() const { return core.radius_m() + rounding_m; }
};

/// The smallest convex body around the points: closed, or a polygon, a segment or a point (triangles
/// without area) where they have no volume. By trying every plane through three of them. Throws
/// std::runtime_error: none or more than kHullPointsMax, or faces that do not join since points are
/// within rounding of lying in one plane.
Mesh HullOf(const std::vector<Vector>& points);

/// The corners of a box with these half extents about the origin.
std::vector<Vector> BoxCorners(const Vector& half);

/// Turned by q / |q| (w, x, y, z) and then moved. Throws std::runtime_error if q has no length.
std::vector<Vector> Placed(std::vector<Vector> points, const std::array<double, 4>& q,
                           const Vector& p);

}  // namespace collision::checker
