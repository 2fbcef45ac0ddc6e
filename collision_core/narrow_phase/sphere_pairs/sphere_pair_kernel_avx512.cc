// Sixteen pairs at once. This file is built for processors that not every machine has, so it
// includes nothing that other files share.
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"
#include "collision_core/simd/lanes_avx512.h"

#ifdef COLLISION_SIMD
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel_wide.h"
#endif

namespace collision::narrow_phase {

const SpherePairKernel* Avx512SpherePairKernel() {
#ifdef COLLISION_SIMD
  return simd::avx512::IsSupported() ? &sphere_pairs::avx512::kKernel : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace collision::narrow_phase
