// Surfaces whose properties are known.
#pragma once

#include <map>
#include <utility>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "tests/support/random.h"

namespace collision {

inline geometry::TriangleMesh Joined(geometry::TriangleMesh a, const geometry::TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const geometry::Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

inline geometry::TriangleMesh Moved(geometry::TriangleMesh mesh, const Eigen::Vector3d& by) {
  for (auto& p : mesh.vertices) p += by;
  return mesh;
}

inline geometry::TriangleMesh Scaled(geometry::TriangleMesh mesh, double by) {
  for (auto& p : mesh.vertices) p *= by;
  return mesh;
}

/// Inside out.
inline geometry::TriangleMesh Reversed(geometry::TriangleMesh mesh) {
  for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Closed, 12 triangles, outward.
inline geometry::TriangleMesh Box(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({i & 1 ? upper.x() : lower.x(), i & 2 ? upper.y() : lower.y(),
                             i & 4 ? upper.z() : lower.z()});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Each triangle in four, `times` over; new vertices half-way.
inline geometry::TriangleMesh Subdivided(geometry::TriangleMesh mesh, int times) {
  for (; times > 0; --times) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> halves;
    const auto half = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = halves.try_emplace(std::minmax(a, b), mesh.vertices.size());
      if (is_new) mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      return at->second;
    };
    std::vector<geometry::Triangle> triangles;
    for (const geometry::Triangle& t : mesh.triangles) {
      const std::uint32_t a = half(t[0], t[1]), b = half(t[1], t[2]), c = half(t[2], t[0]);
      for (const geometry::Triangle& part :
           {geometry::Triangle{t[0], a, c}, geometry::Triangle{a, t[1], b},
            geometry::Triangle{c, b, t[2]}, geometry::Triangle{a, b, c}})
        triangles.push_back(part);
    }
    mesh.triangles = std::move(triangles);
  }
  return mesh;
}

/// 8 · 4^times triangles with their vertices on the unit sphere.
inline geometry::TriangleMesh Sphere(int times) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (; times > 0; --times) {
    mesh = Subdivided(mesh, 1);
    for (auto& p : mesh.vertices) p /= p.norm();
  }
  return mesh;
}

/// A sphere with its vertices at random distances from the middle: spiky, not convex.
inline geometry::TriangleMesh Star(int times, Random& random) {
  geometry::TriangleMesh mesh = Sphere(times);
  for (auto& p : mesh.vertices) p *= random.Uniform(0.3, 1.5);
  return mesh;
}

/// A sphere with its vertices anywhere: closed, and crosses itself everywhere.
inline geometry::TriangleMesh Tangle(int times, Random& random) {
  geometry::TriangleMesh mesh = Sphere(times);
  for (auto& p : mesh.vertices) {
    p = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
  }
  return mesh;
}

/// A square frame around a square hole through z: closed, genus 1, everything in whole numbers.
inline geometry::TriangleMesh Frame() {
  geometry::TriangleMesh mesh;
  // Corner k of the outer and of the inner square, below and above.
  const double x[4] = {-1, 1, 1, -1}, y[4] = {-1, -1, 1, 1};
  for (const double size : {2.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) {
      for (int k = 0; k < 4; ++k) mesh.vertices.push_back({size * x[k], size * y[k], z});
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t n = (k + 1) % 4;
    quad(k, n, 4 + n, 4 + k);            // outside
    quad(8 + n, 8 + k, 12 + k, 12 + n);  // the hole's wall
    quad(4 + k, 4 + n, 12 + n, 12 + k);  // top
    quad(n, k, 8 + k, 8 + n);            // bottom
  }
  return mesh;
}

}  // namespace collision
