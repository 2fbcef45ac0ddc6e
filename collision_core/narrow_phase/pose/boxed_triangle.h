// A triangle of a mesh, posed, with its box.
#pragma once

#include "collision_core/geometry/triangle/triangle_pair.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/shape/shape.h"

namespace collision::narrow_phase {

/// The corners of a triangle in its own body frame. Unchecked: the element is no solid.
inline geometry::TrianglePoints CornersOf(const shape::Shape& shape, ElementIndex triangle) {
  const geometry::TriangleMesh& mesh = shape.mesh();
  const geometry::Triangle& t = mesh.triangles[triangle.value()];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// The corners of a triangle of B, in A's body frame. Unchecked: the element is no solid.
inline geometry::TrianglePoints CornersOf(const shape::Shape& shape, ElementIndex triangle,
                                          const RelativePose& pose) {
  const geometry::TrianglePoints own = CornersOf(shape, triangle);
  return {pose.ToA(own[0]), pose.ToA(own[1]), pose.ToA(own[2])};
}

/// The corners of a posed triangle, and the box around them.
struct BoxedTriangle {
  BoxedTriangle(ElementIndex triangle, const geometry::TrianglePoints& points)
      : index(triangle),
        corners(points),
        lower(points[0].cwiseMin(points[1]).cwiseMin(points[2])),
        upper(points[0].cwiseMax(points[1]).cwiseMax(points[2])) {}

  ElementIndex index;
  geometry::TrianglePoints corners;
  Eigen::Vector3d lower, upper;
};

/// At most the distance of the triangles, but for the rounding that a traversal allows for.
inline double BoxDistance(const BoxedTriangle& a, const BoxedTriangle& b) {
  const Eigen::Vector3d gap =
      (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(Eigen::Vector3d::Zero());
  return gap.norm();
}

}  // namespace collision::narrow_phase
