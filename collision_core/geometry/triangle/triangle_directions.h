// The directions among which one separates two triangles that are apart.
#pragma once

#include <Eigen/Geometry>

#include "collision_core/geometry/triangle/triangle_pair.h"

namespace collision::geometry {

/// Calls `attempt(direction)` for both normals, the cross product of each pair of edges, and each
/// edge's normal within its triangle's plane: one of them separates two triangles that are apart,
/// but for rounding. Directions have any length; zero where features are parallel.
template <typename Attempt>
void ForEachFeatureDirection(const TrianglePoints& a, const TrianglePoints& b, Attempt attempt) {
  const Eigen::Vector3d edges_a[3] = {a[1] - a[0], a[2] - a[1], a[0] - a[2]};
  const Eigen::Vector3d edges_b[3] = {b[1] - b[0], b[2] - b[1], b[0] - b[2]};
  const Eigen::Vector3d normal_a = edges_a[0].cross(edges_a[1]);
  const Eigen::Vector3d normal_b = edges_b[0].cross(edges_b[1]);
  attempt(normal_a);
  attempt(normal_b);
  for (const Eigen::Vector3d& e : edges_a) {
    attempt(normal_a.cross(e));
    for (const Eigen::Vector3d& f : edges_b) attempt(e.cross(f));
  }
  for (const Eigen::Vector3d& f : edges_b) attempt(normal_b.cross(f));
}

}  // namespace collision::geometry
