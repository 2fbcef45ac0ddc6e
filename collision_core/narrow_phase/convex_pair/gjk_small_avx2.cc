// Four lanes at once. This file is built for processors that not every machine has, so it includes
// nothing that other files share.
#include "collision_core/narrow_phase/convex_pair/gjk_small.h"
#include "collision_core/simd/lanes_avx2.h"

#ifdef COLLISION_SIMD
#include "collision_core/narrow_phase/convex_pair/gjk_small_wide.h"
#endif

namespace collision::narrow_phase {

SmallGjkKernel Avx2SmallGjk() {
#ifdef COLLISION_SIMD
  return simd::avx2::IsSupported() ? &gjk_small::avx2::Find : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace collision::narrow_phase
