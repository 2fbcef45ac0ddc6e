#define WIDE
#include "collision_core/narrow_phase/quick_search_wide.h"

namespace collision {

QuickKernel PlainQuickSearch() { return &Find; }

QuickDistance SearchQuickly(const QuickPair& pair) {
  static const QuickKernel kernel = Avx2QuickSearch() ? Avx2QuickSearch() : PlainQuickSearch();
  return kernel(pair);
}

}  // namespace collision
