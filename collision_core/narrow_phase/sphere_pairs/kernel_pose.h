// Two posed bodies as the kernels of sphere_pair_kernel.h see them.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {

/// A body as wide vectors see it; that of a ball has one pack.
struct PackedBody {
  explicit PackedBody(const BodyTree& surface);
  PackedBody(const PackedBody&) = delete;
  PackedBody& operator=(const PackedBody&) = delete;

  std::uint32_t LinkOf(sphere_tree::BallRef which) const {
    return packs[which / sphere_tree::kPackBalls].link[which % sphere_tree::kPackBalls];
  }
  float RadiusOf(sphere_tree::BallRef which) const {
    return packs[which / sphere_tree::kPackBalls].radius[which % sphere_tree::kPackBalls];
  }
  Eigen::Vector3f CentreOf(sphere_tree::BallRef which) const {
    const sphere_tree::BallPack& pack = packs[which / sphere_tree::kPackBalls];
    const std::uint32_t i = which % sphere_tree::kPackBalls;
    return {pack.x[i], pack.y[i], pack.z[i]};
  }
  NodeIndex NodeOf(sphere_tree::BallRef which) const {
    return tree ? tree->NodeOf(which) : sphere_tree::SphereTree::kRoot;
  }

  const sphere_tree::PackedTree* tree;  ///< Null: a ball.
  const sphere_tree::BallPack* packs;
  Eigen::Vector3d origin;
  double extent;
  sphere_tree::BallPack ball;
};

/// `slack`: what rounding may have made of a distance computed in doubles. The result counts only
/// for an offset far below 1e19 m, whose square single precision holds: SeparationSearch discards
/// it beyond.
KernelPose KernelPoseOf(const PackedBody& a, const PackedBody& b, const RelativePose& pose,
                        double slack);

}  // namespace collision::narrow_phase
