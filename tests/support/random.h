// One seeded source of random numbers for all tests: the same numbers on every platform.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace collision {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014). It uses no std::*_distribution and no
/// transcendental function: both differ between standard libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  /// A whole number in [0, n), n > 0.
  std::uint64_t Below(std::uint64_t n) { return Next() % n; }

  /// A number in [lo, hi].
  double Uniform(double lo, double hi) {
    const double unit = static_cast<double>(Next() >> 11) * 0x1p-53;
    return lo + (hi - lo) * unit;
  }

  /// A number in [lo, hi], 0 < lo <= hi: each power of two is equally likely, uniform between them.
  double LogUniform(double lo, double hi) {
    const int exponent_lo = std::ilogb(lo);
    const int exponents = std::ilogb(hi) - exponent_lo + 1;
    for (;;) {
      const int exponent = exponent_lo + static_cast<int>(Below(exponents));
      const double x = std::ldexp(Uniform(1, 2), exponent);
      if (lo <= x && x <= hi) return x;
      if (lo == hi) return lo;
    }
  }

  bool Chance(double probability) { return Uniform(0, 1) < probability; }

  /// A direction, all equally likely.
  Eigen::Vector3d UnitVector() {
    for (;;) {
      const double x = Uniform(-1, 1), y = Uniform(-1, 1), z = Uniform(-1, 1);
      const double length = std::sqrt(x * x + y * y + z * z);
      if (length > 1e-3 && length <= 1) return {x / length, y / length, z / length};
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace collision
