// The cube root, the same on every machine.
#pragma once

#include <cmath>

namespace collision::numeric {

/// The cube root of a > 0 to about fifteen digits, by Newton's method; the same bits on every
/// machine, which std::cbrt does not promise. Not certified: use it where any value near the root
/// will do.
inline double CubeRoot(double a) {
  int exponent;
  std::frexp(a, &exponent);
  double root = std::ldexp(1.0, exponent / 3);
  for (int step = 0; step < 8; ++step) root -= (root - a / (root * root)) / 3;
  return root;
}

}  // namespace collision::numeric
