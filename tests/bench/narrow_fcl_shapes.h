// Convex solids as FCL takes them.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>

#include <memory>

#include "tests/bench/narrow_convex.h"

namespace collision::bench {

inline std::shared_ptr<fcl::CollisionGeometryd> FclHull(const PlainMesh& mesh) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto& p : mesh.vertices) vertices->emplace_back(p[0], p[1], p[2]);
  // Each face: how many corners, and then these.
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& t : mesh.triangles) {
    faces->push_back(3);
    for (const std::uint32_t v : t) faces->push_back(static_cast<int>(v));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.triangles.size()), faces);
}

inline std::shared_ptr<fcl::CollisionGeometryd> FclGeometry(const PlainConvex& convex) {
  const auto& [x, y, z] = convex.half;
  switch (convex.kind) {
    case PlainConvex::Kind::kCapsule:
      return std::make_shared<fcl::Capsuled>(convex.radius, 2 * z);
    case PlainConvex::Kind::kBox:
      return std::make_shared<fcl::Boxd>(2 * x, 2 * y, 2 * z);
    case PlainConvex::Kind::kHull:
      break;
  }
  return FclHull(convex.hull);
}

}  // namespace collision::bench
