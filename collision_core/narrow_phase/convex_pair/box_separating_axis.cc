#include "collision_core/narrow_phase/convex_pair/box_separating_axis.h"

#include "collision_core/simd/lanes_plain.h"

// The kernel comes after its lanes.
#include "collision_core/narrow_phase/convex_pair/box_separating_axis_wide.h"

namespace collision::narrow_phase {

SeparatingAxisKernel PlainSeparatingAxisTest() { return &box_separating_axis::plain::TestAxes; }

BoxSeparation TestSeparatingAxes(const BoxPair& pair) {
  static const SeparatingAxisKernel kernel =
      Avx2SeparatingAxisTest() ? Avx2SeparatingAxisTest() : PlainSeparatingAxisTest();
  return kernel(pair);
}

}  // namespace collision::narrow_phase
