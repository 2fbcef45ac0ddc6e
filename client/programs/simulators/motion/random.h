// The simulators' seeded random numbers.
#pragma once

#include <cstdint>

#include "collision/types.h"

namespace collision::client {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): the same numbers on every platform.
class SeededRandom {
 public:
  explicit SeededRandom(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  /// A number in [lo, hi].
  double Uniform(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(Next() >> 11) * 0x1p-53);
  }

  /// Uniformly distributed over the unit ball.
  Vector3 InUnitBall() {
    for (;;) {
      const Vector3 x = {Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1)};
      if (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] <= 1) return x;
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace collision::client
