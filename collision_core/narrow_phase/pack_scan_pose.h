// Two posed bodies as the kernels of pack_scan.h see them.
#pragma once

#include <cmath>
#include <limits>

#include "collision_core/narrow_phase/pack_scan.h"
#include "collision_core/narrow_phase/separation.h"

namespace collision {

/// A body as wide vectors see it; that of a ball has one pack.
struct PackedBody {
  explicit PackedBody(const Surface& surface);
  PackedBody(const PackedBody&) = delete;
  PackedBody& operator=(const PackedBody&) = delete;

  std::uint32_t LinkOf(BallRef ball) const {
    return packs[ball / kPackBalls].link[ball % kPackBalls];
  }
  float RadiusOf(BallRef ball) const { return packs[ball / kPackBalls].radius[ball % kPackBalls]; }
  Eigen::Vector3f CentreOf(BallRef ball) const {
    const BallPack& pack = packs[ball / kPackBalls];
    const std::uint32_t i = ball % kPackBalls;
    return {pack.x[i], pack.y[i], pack.z[i]};
  }
  std::uint32_t NodeOf(BallRef ball) const { return tree ? tree->NodeOf(ball) : 0; }

  const PackedTree* tree;  ///< Null: a ball.
  const BallPack* packs;
  Eigen::Vector3d origin;
  double extent;
  BallPack ball;
};

/// Single precision, no less than x; of zero nearly zero. A cast is off by 2^-24 of itself, or by
/// less than the least normal number.
inline float FloatUp(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded + (std::abs(rounded) * 0x1p-22f + std::numeric_limits<float>::min());
}

/// `slack`: what rounding may have made of a distance computed in doubles. Requires an offset far
/// below 1e19 m, whose square single precision holds.
ScanPose ScanPoseOf(const PackedBody& a, const PackedBody& b, const RelativePose& pose,
                    double slack);

}  // namespace collision
