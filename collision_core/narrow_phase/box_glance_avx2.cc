// Four lanes at once. Nothing that others share is included: this file is built for processors that
// not everybody has.
#include "collision_core/narrow_phase/box_glance.h"

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 256
#define WIDE __attribute__((target("avx2")))
#include "collision_core/narrow_phase/box_glance_wide.h"

namespace collision {

BoxGlanceKernel Avx2BoxGlance() { return __builtin_cpu_supports("avx2") ? &Glance : nullptr; }

}  // namespace collision
#else
namespace collision {

BoxGlanceKernel Avx2BoxGlance() { return nullptr; }

}  // namespace collision
#endif
