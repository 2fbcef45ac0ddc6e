// One lane: plain floats, for every processor.
//
// A source file includes one lanes header before the kernel (x_wide.h) that it compiles.
//
// The dialect, in namespace simd; everything is in an anonymous namespace, for one source file:
//   COLLISION_LANES     defined where this build may contain code for the processor
//   WIDE                the attribute of every function that uses lanes
//   Lanes, kWidth       kWidth floats with the operators of float, lane by lane
//   Load, Store, All    from and to memory, unaligned; one value in all lanes
//   Lesser, Greater     of two; the second where they do not compare (NaN)
//   Root                the square root, correctly rounded
//   NotGreater, NotLess, NotAtLeast
//                       a mask of the lanes for which a > b (a < b, a >= b) does not hold: NaN
//                       counts
//   Lowest              a mask of the first lanes, at most kWidth
//   StoreSelected       first + lane for each lane of a mask, ascending; returns how many
//   StoreCopies         one value, `count` times. Both may write up to kWidth entries.
#pragma once

#include <cmath>
#include <cstdint>

#define COLLISION_LANES 1
#define WIDE

namespace collision::simd {
namespace {

using Lanes = float;
constexpr std::uint32_t kWidth = 1;

inline Lanes Load(const float* values) { return *values; }
inline void Store(float* to, Lanes lanes) { *to = lanes; }
inline Lanes All(float value) { return value; }
inline Lanes Lesser(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes Greater(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes Root(Lanes a) { return std::sqrt(a); }
inline unsigned NotGreater(Lanes a, Lanes b) { return !(a > b); }
inline unsigned NotLess(Lanes a, Lanes b) { return !(a < b); }
inline unsigned NotAtLeast(Lanes a, Lanes b) { return !(a >= b); }

/// A mask of the first `count` lanes, or of all.
inline unsigned Lowest(std::uint32_t count) {
  return (1u << (count < kWidth ? count : kWidth)) - 1;
}

inline std::uint32_t StoreSelected(unsigned mask, std::uint32_t first, std::uint32_t* to) {
  *to = first;
  return mask;
}
inline void StoreCopies(std::uint32_t value, std::uint32_t /*count*/, std::uint32_t* to) {
  *to = value;
}

}  // namespace
}  // namespace collision::simd
