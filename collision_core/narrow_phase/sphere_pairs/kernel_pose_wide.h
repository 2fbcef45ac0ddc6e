// Points of B as seen from A, in wide vectors. For sphere_pair_kernel_wide.h.
#pragma once

#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"
#include "collision_core/simd/points_wide.h"

namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD {

using namespace simd::COLLISION_SIMD;

/// Turned as B is; not shifted.
WIDE inline Points Turned(const KernelPose& pose, const Points& p) {
  const float* const m = pose.matrix;
  return {(All(m[0]) * p.x + All(m[1]) * p.y) + All(m[2]) * p.z,
          (All(m[3]) * p.x + All(m[4]) * p.y) + All(m[5]) * p.z,
          (All(m[6]) * p.x + All(m[7]) * p.y) + All(m[8]) * p.z};
}

WIDE inline Points Posed(const KernelPose& pose, const Points& p) {
  return Turned(pose, p) + AllOf(pose.offset);
}

}  // namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD
