// A mesh of the caller as the core has it.
#pragma once

#include "collision/shape.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"

namespace collision::client {

inline geometry::TriangleMesh ToCore(const Triangles& triangles) {
  geometry::TriangleMesh mesh;
  mesh.vertices.reserve(triangles.vertices_m.size());
  for (const Vector3& p : triangles.vertices_m) mesh.vertices.emplace_back(p[0], p[1], p[2]);
  mesh.triangles = triangles.indices;
  return mesh;
}

}  // namespace collision::client
