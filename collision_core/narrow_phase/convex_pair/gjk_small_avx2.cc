// Four lanes at once. Nothing that others share is included: this file is built for processors that
// not every processor has.
#include "collision_core/narrow_phase/convex_pair/gjk_small.h"

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 256
#define WIDE __attribute__((target("avx2")))
#include "collision_core/narrow_phase/convex_pair/gjk_small_wide.h"

namespace collision::narrow_phase {

SmallGjkKernel Avx2SmallGjk() { return __builtin_cpu_supports("avx2") ? &Find : nullptr; }

}  // namespace collision::narrow_phase
#else
namespace collision::narrow_phase {

SmallGjkKernel Avx2SmallGjk() { return nullptr; }

}  // namespace collision::narrow_phase
#endif
