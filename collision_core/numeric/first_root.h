// When a gap that closes is used up.
#pragma once

#include <cmath>

#include "collision_core/numeric/rounding.h"

namespace collision::numeric {

/// Makes a computed root a lower bound: it takes a dozen roundings of 2^-53 each, none of them
/// after a cancellation.
inline constexpr double kRootShare = 1 - 0x1p-40;

/// A lower bound on the least x >= 0 with gap − closing x − growth x² <= 0; growth >= 0. 0 if
/// something overflows.
inline double FirstRoot(double gap, double closing, double growth) {
  if (!(gap > 0)) return 0;
  const double root = std::sqrt(closing * closing + 4 * growth * gap);
  if (!(root < kInfinity)) return 0;
  if (closing >= 0) {
    const double sum = closing + root;
    return sum > 0 ? kRootShare * (2 * gap / sum) : kInfinity;
  }
  return growth > 0 ? kRootShare * ((root - closing) / (2 * growth)) : kInfinity;
}

}  // namespace collision::numeric
