// The cube root, the same on every machine.
#pragma once

#include <cmath>

namespace collision {

/// Of a > 0, good to about fifteen digits; the library's differs from machine to machine.
inline double CubeRoot(double a) {
  int exponent;
  std::frexp(a, &exponent);
  double root = std::ldexp(1.0, exponent / 3);
  for (int step = 0; step < 8; ++step) root -= (root - a / (root * root)) / 3;
  return root;
}

}  // namespace collision
