// Four doubles at once, in the vector type of g++ and clang, which they translate for any
// processor. After a lanes header (lanes_plain.h), whose kind of processor they are compiled for.
#pragma once

namespace collision::simd::COLLISION_SIMD {

/// With the operators of double, lane by lane; doubles[i] is lane i.
using Doubles = double __attribute__((vector_size(32)));
/// The result of a comparison: all bits of a lane are one, or none.
using DoublesMask = long long __attribute__((vector_size(32)));

WIDE_INLINE Doubles Load(const double* values) {
  Doubles doubles;
  __builtin_memcpy(&doubles, values, sizeof(doubles));
  return doubles;
}

WIDE_INLINE Doubles Magnitude(const Doubles& x) {
  constexpr long long kAllButSign = 0x7fffffffffffffff;
  return reinterpret_cast<Doubles>(reinterpret_cast<DoublesMask>(x) & kAllButSign);
}

/// x where the mask is set, else +0.
WIDE_INLINE Doubles Selected(const Doubles& x, const DoublesMask& mask) {
  return reinterpret_cast<Doubles>(reinterpret_cast<DoublesMask>(x) & mask);
}

// The first three lanes are x, y and z of something, and the fourth is not used.

/// The lanes y, z, x.
WIDE_INLINE Doubles Next(const Doubles& x) { return __builtin_shufflevector(x, x, 1, 2, 0, 3); }
/// The lanes z, x, y.
WIDE_INLINE Doubles Previous(const Doubles& x) { return __builtin_shufflevector(x, x, 2, 0, 1, 3); }
WIDE_INLINE double SumOfThree(const Doubles& x) { return (x[0] + x[1]) + x[2]; }
WIDE_INLINE bool AnyOfThree(const DoublesMask& mask) { return (mask[0] | mask[1] | mask[2]) != 0; }
WIDE_INLINE bool AllOfThree(const DoublesMask& mask) { return (mask[0] & mask[1] & mask[2]) != 0; }

/// The greater (lesser) of two doubles; the second one where they do not compare.
WIDE_INLINE double Greater(double x, double y) { return x > y ? x : y; }
WIDE_INLINE double Lesser(double x, double y) { return x < y ? x : y; }

}  // namespace collision::simd::COLLISION_SIMD
