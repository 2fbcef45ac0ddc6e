// Boxes in single precision, as some libraries want them, rounded outward.
#pragma once

#include <cmath>

namespace collision::bench {

/// Below x by at most two units in the last place of a float, without a branch: the difference is
/// at least the half unit that the conversion may add, also where floats are denormal.
inline float RoundedDown(double x) {
  return static_cast<float>(x - (std::abs(x) * 0x1p-23 + 0x1p-149));
}

inline float RoundedUp(double x) { return -RoundedDown(-x); }

}  // namespace collision::bench
