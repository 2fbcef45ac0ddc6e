#define WIDE
#include "collision_core/narrow_phase/box_glance_wide.h"

namespace collision {

BoxGlanceKernel PlainBoxGlance() { return &Glance; }

BoxGlance GlanceAt(const BoxPair& pair) {
  static const BoxGlanceKernel kernel = Avx2BoxGlance() ? Avx2BoxGlance() : PlainBoxGlance();
  return kernel(pair);
}

}  // namespace collision
