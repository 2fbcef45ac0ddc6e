#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"

#include "collision_core/simd/lanes_plain.h"

// The kernel comes after its lanes.
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel_wide.h"

namespace collision::narrow_phase {

const SpherePairKernel* PlainSpherePairKernel() { return &sphere_pairs::plain::kKernel; }

const SpherePairKernel& WidestSpherePairKernel() {
  static const SpherePairKernel& widest = Avx512SpherePairKernel() ? *Avx512SpherePairKernel()
                                          : Avx2SpherePairKernel() ? *Avx2SpherePairKernel()
                                                                   : sphere_pairs::plain::kKernel;
  return widest;
}

}  // namespace collision::narrow_phase
