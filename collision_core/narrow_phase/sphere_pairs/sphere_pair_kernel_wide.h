// The kernels of sphere_pair_kernel.h. After a lanes header (simd/).
#pragma once

#include "collision_core/narrow_phase/sphere_pairs/kernel_balls_wide.h"
#include "collision_core/narrow_phase/sphere_pairs/kernel_triangles_wide.h"

namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD {

inline constexpr SpherePairKernel kKernel = {&ScanBalls, &ScanTriangles};

}  // namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD
