#include "collision_core/narrow_phase/convex_pair/gjk_small.h"

#include "collision_core/simd/lanes_plain.h"

// The kernel comes after its lanes.
#include "collision_core/narrow_phase/convex_pair/gjk_small_wide.h"

namespace collision::narrow_phase {

SmallGjkKernel PlainSmallGjk() { return &gjk_small::plain::Find; }

SmallGjkResult RunSmallGjk(const SmallGjkPair& pair) {
  static const SmallGjkKernel kernel = Avx2SmallGjk() ? Avx2SmallGjk() : PlainSmallGjk();
  return kernel(pair);
}

}  // namespace collision::narrow_phase
