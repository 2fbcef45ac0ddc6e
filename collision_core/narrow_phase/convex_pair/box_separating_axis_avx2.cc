// Four lanes at once. This file is built for processors that not every machine has, so it includes
// nothing that other files share.
#include "collision_core/narrow_phase/convex_pair/box_separating_axis.h"
#include "collision_core/simd/lanes_avx2.h"

#ifdef COLLISION_SIMD
#include "collision_core/narrow_phase/convex_pair/box_separating_axis_wide.h"
#endif

namespace collision::narrow_phase {

SeparatingAxisKernel Avx2SeparatingAxisTest() {
#ifdef COLLISION_SIMD
  return simd::avx2::IsSupported() ? &box_separating_axis::avx2::TestAxes : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace collision::narrow_phase
