// Eight floats in the vector type of g++ and clang, which they translate for any processor: the
// reference, and the definition of the dialect.
//
// A source file for one kind of processor includes a lanes header first, and after it the kernels
// (x_wide.h) that it compiles. The lanes header defines
//   COLLISION_SIMD      the namespace of this kind: plain, avx2 or avx512; not defined where this
//                       build may not contain code for it
//   WIDE                the attribute of every function that uses lanes
//   WIDE_INLINE         the same for a function that is always inlined
// and in namespace simd::COLLISION_SIMD, of which all but IsSupported() may be called only where
// IsSupported():
//   IsSupported         whether this processor can run the code
//   Lanes, kWidth       kWidth floats, 8 or 16, with the operators + − · / lane by lane
//   kAllLanes           the mask of all lanes; lane i is bit i of a mask
//   Load, Store, All    from and to memory, unaligned; one value in all lanes
//   LoadEight, LoadFour eight (four) values from memory, again and again
//   SpreadEights        v[i] in the first eight lanes, v[j] in the next ones, if there are any
//   SpreadFours         v[i] in the first four lanes, v[i + 1] in the next four, and so on; up to
//                       v[i + kWidth / 4 − 1] is used, and v[i] to v[i + 3] are read
//   Lesser, Greater     of two; the second where they do not compare (NaN)
//   Root                the square root, correctly rounded
//   WhereGreater        a where a > b, else a third value; also for NaN
//   LeastOf             the least lane; none may be NaN
//   NotGreater, NotLess, NotAtLeast
//                       the mask of the lanes for which a > b (a < b, a >= b) does not hold: NaN
//                       counts
//   Lowest              the mask of the first lanes, at most kWidth
//   StoreSelected       first + lane for each lane of a mask, ascending; returns how many
//   StoreCopies         one value, `count` times. Both may write up to kWidth entries.
//
// Each kind has a namespace of its own, so that no two files define one function differently.
#pragma once

#include <cmath>
#include <cstdint>

#define COLLISION_SIMD plain
#define WIDE
#define WIDE_INLINE inline __attribute__((always_inline))

namespace collision::simd::plain {

inline bool IsSupported() { return true; }

constexpr std::uint32_t kWidth = 8;
constexpr unsigned kAllLanes = (1u << kWidth) - 1;

// Passing such vectors depends on the processor; all functions that do are inlined. The warning is
// off to the end of the source, since the kernels that follow pass such vectors, too.
#pragma GCC diagnostic ignored "-Wpsabi"

using Lanes = float __attribute__((vector_size(4 * kWidth)));

template <typename Each>
WIDE_INLINE Lanes Map(Each each) {
  return Lanes{each(0), each(1), each(2), each(3), each(4), each(5), each(6), each(7)};
}
template <typename Each>
WIDE_INLINE unsigned MaskOf(Each each) {
  unsigned mask = 0;
  for (std::uint32_t i = 0; i < kWidth; ++i) mask |= unsigned{each(i)} << i;
  return mask;
}

WIDE_INLINE Lanes Load(const float* values) {
  Lanes lanes;
  __builtin_memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}
WIDE_INLINE void Store(float* to, const Lanes& lanes) {
  __builtin_memcpy(to, &lanes, sizeof(lanes));
}
WIDE_INLINE Lanes All(float value) {
  return Map([&](std::uint32_t) { return value; });
}
WIDE_INLINE Lanes LoadEight(const float* values) { return Load(values); }
WIDE_INLINE Lanes LoadFour(const float* values) {
  return Map([&](std::uint32_t i) { return values[i % 4]; });
}
WIDE_INLINE Lanes SpreadEights(const float* values, std::uint32_t i, std::uint32_t /*j*/) {
  return All(values[i]);
}
WIDE_INLINE Lanes SpreadFours(const float* values, std::uint32_t first) {
  return Map([&](std::uint32_t i) { return values[first + i / 4]; });
}

WIDE_INLINE Lanes Lesser(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
WIDE_INLINE Lanes Greater(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
WIDE_INLINE Lanes Root(const Lanes& a) {
  return Map([&](std::uint32_t i) { return std::sqrt(a[i]); });
}
WIDE_INLINE Lanes WhereGreater(const Lanes& a, const Lanes& b, const Lanes& other) {
  return a > b ? a : other;
}
WIDE_INLINE float LeastOf(const Lanes& a) {
  float least = a[0];
  for (std::uint32_t i = 1; i < kWidth; ++i) least = a[i] < least ? a[i] : least;
  return least;
}

WIDE_INLINE unsigned NotGreater(const Lanes& a, const Lanes& b) {
  return MaskOf([&](std::uint32_t i) { return !(a[i] > b[i]); });
}
WIDE_INLINE unsigned NotLess(const Lanes& a, const Lanes& b) {
  return MaskOf([&](std::uint32_t i) { return !(a[i] < b[i]); });
}
WIDE_INLINE unsigned NotAtLeast(const Lanes& a, const Lanes& b) {
  return MaskOf([&](std::uint32_t i) { return !(a[i] >= b[i]); });
}
inline unsigned Lowest(std::uint32_t count) {
  return (1u << (count < kWidth ? count : kWidth)) - 1;
}

inline std::uint32_t StoreSelected(unsigned mask, std::uint32_t first, std::uint32_t* to) {
  std::uint32_t count = 0;
  for (; mask != 0; mask &= mask - 1) {
    to[count++] = first + static_cast<unsigned>(__builtin_ctz(mask));
  }
  return count;
}
inline void StoreCopies(std::uint32_t value, std::uint32_t count, std::uint32_t* to) {
  for (std::uint32_t k = 0; k < count; ++k) to[k] = value;
}

}  // namespace collision::simd::plain
