#include "collision_core/numeric/interval.h"

namespace collision::numeric {

Interval MultiplyWide(const Interval& a, const Interval& b) {
  if (a.upper <= 0) return -MultiplyWide(-a, b);
  if (a.lower >= 0) {
    return {MultiplyDown(b.lower >= 0 ? a.lower : a.upper, b.lower),
            MultiplyUp(b.upper >= 0 ? a.upper : a.lower, b.upper)};
  }
  if (b.lower >= 0 || b.upper <= 0) return MultiplyWide(b, a);
  return {std::min(MultiplyDown(a.lower, b.upper), MultiplyDown(a.upper, b.lower)),
          std::max(MultiplyUp(a.lower, b.lower), MultiplyUp(a.upper, b.upper))};
}

}  // namespace collision::numeric
