// A mesh and a pose as FCL takes them.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/motion/interp_motion.h>

#include <memory>

#include "tests/bench/narrow_query.h"

namespace collision::bench {

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

inline fcl::Transform3d FclPose(const PlainPose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) transform.linear()(i, j) = pose.rotation[i][j];
    transform.translation()(i) = pose.offset[i];
  }
  return transform;
}

/// Even motion between two poses. Given only these, version 0.7 turns bodies about a point that it
/// never sets; so it is set here.
inline fcl::InterpMotion<double> FclMotion(const fcl::Transform3d& begin,
                                           const fcl::Transform3d& end) {
  const fcl::Vector3d origin(0, 0, 0);
  return {begin.linear(), begin.translation(), end.linear(), end.translation(), origin};
}

}  // namespace collision::bench
