// Four lanes at once. Nothing that others share is included: this file is built for processors that
// not everybody has.
#include "collision_core/narrow_phase/quick_search.h"

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 256
#define WIDE __attribute__((target("avx2")))
#include "collision_core/narrow_phase/quick_search_wide.h"

namespace collision {

QuickKernel Avx2QuickSearch() { return __builtin_cpu_supports("avx2") ? &Find : nullptr; }

}  // namespace collision
#else
namespace collision {

QuickKernel Avx2QuickSearch() { return nullptr; }

}  // namespace collision
#endif
