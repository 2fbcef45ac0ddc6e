// Meshes, convex solids and poses in FCL's types.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>

#include <memory>

#include "tests/bench/pairs/plain_convex.h"

namespace collision::bench {

using FclGeometry = std::shared_ptr<fcl::CollisionGeometryd>;

template <typename Volume>
std::shared_ptr<fcl::BVHModel<Volume>> FclModel(const PlainMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  for (const auto& p : mesh.vertices) vertices.emplace_back(p[0], p[1], p[2]);
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<fcl::BVHModel<Volume>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

inline FclGeometry FclBox(const std::array<double, 3>& half) {
  return std::make_shared<fcl::Boxd>(2 * half[0], 2 * half[1], 2 * half[2]);
}

inline FclGeometry FclHull(const PlainMesh& mesh) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto& p : mesh.vertices) vertices->emplace_back(p[0], p[1], p[2]);
  // Each face: the number of its corners, and then these.
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& t : mesh.triangles) {
    faces->push_back(3);
    for (const std::uint32_t v : t) faces->push_back(static_cast<int>(v));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.triangles.size()), faces);
}

inline FclGeometry FclSolid(const PlainConvex& convex) {
  switch (convex.kind) {
    case PlainConvex::Kind::kCapsule:
      return std::make_shared<fcl::Capsuled>(convex.radius, 2 * convex.half[2]);
    case PlainConvex::Kind::kBox:
      return FclBox(convex.half);
    case PlainConvex::Kind::kHull:
      break;
  }
  return FclHull(convex.hull);
}

inline fcl::Transform3d FclPose(const PlainPose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) transform.linear()(i, j) = pose.rotation[i][j];
    transform.translation()(i) = pose.offset[i];
  }
  return transform;
}

}  // namespace collision::bench
