// When a gap that closes is used up.
#pragma once

#include <cmath>

#include "collision_core/numeric/rounding.h"

namespace collision::numeric {

/// Makes a computed root a lower bound: it takes a dozen roundings of 2^-53 each, none of them
/// after a cancellation.
inline constexpr double kRootShare = 1 - 0x1p-40;

/// From this discriminant on, what its terms lose to underflow is less than a rounding of it.
inline constexpr double kRootDiscriminantMin = 0x1p-900;

/// Where the discriminant is less, a gap that closes more slowly than this [m/s] is taken to close
/// at this speed: then its root is earlier, and the discriminant is large enough.
inline constexpr double kClosingMin = 0x1p-440;

/// A root below this is taken as 0 [s]: a smaller quotient may be rounded up by underflow.
inline constexpr double kRootMin = 0x1p-1000;

/// A lower bound on the least x >= 0 with gap − closing x − growth x² <= 0; +infinity if there is
/// none, or none that is a double; 0 if something overflows. Plain doubles, and early by 2^-40 of
/// itself at usual magnitudes: FirstZero() (cubic.h) is the tight one. Unchecked: growth >= 0.
inline double FirstRoot(double gap, double closing, double growth) {
  if (!(gap > 0)) return 0;
  if (closing <= 0 && growth == 0) return kInfinity;
  double discriminant = closing * closing + 4 * growth * gap;
  if (discriminant < kRootDiscriminantMin) {
    closing = closing < kClosingMin ? kClosingMin : closing;
    discriminant = closing * closing + 4 * growth * gap;
  }
  const double root = std::sqrt(discriminant);
  if (!(root < kInfinity)) return 0;
  const double x = closing >= 0 ? 2 * gap / (closing + root) : (root - closing) / (2 * growth);
  return x < kRootMin ? 0 : kRootShare * x;
}

}  // namespace collision::numeric
