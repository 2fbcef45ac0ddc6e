#define WIDE
#include "collision_core/narrow_phase/convex_pair/box_separating_axis_wide.h"

namespace collision::narrow_phase {

SeparatingAxisKernel PlainSeparatingAxisTest() { return &Glance; }

BoxSeparation TestSeparatingAxes(const BoxPair& pair) {
  static const SeparatingAxisKernel kernel =
      Avx2SeparatingAxisTest() ? Avx2SeparatingAxisTest() : PlainSeparatingAxisTest();
  return kernel(pair);
}

}  // namespace collision::narrow_phase
