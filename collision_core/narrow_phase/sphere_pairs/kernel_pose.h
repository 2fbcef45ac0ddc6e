// Two posed bodies as the kernels of sphere_pair_kernel.h see them.
#pragma once

#include <cmath>
#include <limits>

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"

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

/// Single precision, no less than x; of zero nearly zero. A cast is off by 2^-24 of itself, or by
/// less than the least normal number.
inline float FloatUp(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded + (std::abs(rounded) * 0x1p-22f + std::numeric_limits<float>::min());
}

/// `slack`: what rounding may have made of a distance computed in doubles. The result counts only
/// for an offset far below 1e19 m, whose square single precision holds: SeparationSearch discards
/// it beyond.
KernelPose KernelPoseOf(const PackedBody& a, const PackedBody& b, const RelativePose& pose,
                        double slack);

}  // namespace collision::narrow_phase
