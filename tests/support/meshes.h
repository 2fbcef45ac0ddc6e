// Small surfaces for tests of shapes: convex, not convex, open, thin.
#pragma once

#include "tests/collision_core/sphere_tree/meshes.h"

namespace collision {

/// Closed, 12 triangles, about the origin.
inline geometry::TriangleMesh Cube(double half) {
  return Box({-half, -half, -half}, {half, half, half});
}

/// Closed, 4 triangles; corners on every second corner of the cube.
inline geometry::TriangleMesh Tetrahedron(double half) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {
      {half, half, half}, {half, -half, -half}, {-half, half, -half}, {-half, -half, half}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  return mesh;
}

/// Closed, along x, square in section.
inline geometry::TriangleMesh Rod(double half_length, double half_width) {
  return Box({-half_length, -half_width, -half_width}, {half_length, half_width, half_width});
}

/// Closed, not convex, 20 triangles: the polygon (0,0) (2,0) (2,1) (1,1) (1,2) (0,2), moved by
/// (-1, -1), between z = −½ and ½.
inline geometry::TriangleMesh LShape() {
  geometry::TriangleMesh mesh;
  for (const double z : {-0.5, 0.5}) {
    mesh.vertices.insert(mesh.vertices.end(),
                         {{-1, -1, z}, {1, -1, z}, {1, 0, z}, {0, 0, z}, {0, 1, z}, {-1, 1, z}});
  }
  const geometry::Triangle caps[] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const geometry::Triangle& t : caps) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t n = (k + 1) % 6;
    mesh.triangles.push_back({k, n, n + 6});
    mesh.triangles.push_back({k, n + 6, k + 6});
  }
  return mesh;
}

/// Open: a square in the plane z = 0, in cells · cells · 2 triangles.
inline geometry::TriangleMesh Sheet(double half, std::uint32_t cells) {
  geometry::TriangleMesh mesh;
  const double step = 2 * half / cells;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      mesh.vertices.push_back({-half + step * i, -half + step * j, 0});
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t k = j * (cells + 1) + i;
      mesh.triangles.push_back({k, k + 1, k + cells + 2});
      mesh.triangles.push_back({k, k + cells + 2, k + cells + 1});
    }
  }
  return mesh;
}

/// Closed: a cube with a cubic hole inside.
inline geometry::TriangleMesh HollowCube(double half, double hole) {
  return Joined(Cube(half), Reversed(Cube(hole)));
}

}  // namespace collision
