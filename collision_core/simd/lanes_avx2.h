// Eight lanes: processors with AVX2. The dialect is that of lanes_plain.h.
#pragma once

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 256
#include <immintrin.h>

#include <cstdint>

#define COLLISION_LANES 8
#define WIDE __attribute__((target("avx2")))

namespace collision::simd {
namespace {

using Lanes = __m256;
constexpr std::uint32_t kWidth = 8;

WIDE inline Lanes Load(const float* values) { return _mm256_loadu_ps(values); }
WIDE inline void Store(float* to, Lanes lanes) { _mm256_storeu_ps(to, lanes); }
WIDE inline Lanes All(float value) { return _mm256_set1_ps(value); }
WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm256_min_ps(a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm256_max_ps(a, b); }
WIDE inline Lanes Root(Lanes a) { return _mm256_sqrt_ps(a); }
WIDE inline unsigned Mask(Lanes lanes) { return static_cast<unsigned>(_mm256_movemask_ps(lanes)); }
WIDE inline unsigned NotGreater(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NGT_UQ)); }
WIDE inline unsigned NotLess(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NLT_UQ)); }
WIDE inline unsigned NotAtLeast(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NGE_UQ)); }

/// A mask of the first `count` lanes, or of all.
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

}  // namespace
}  // namespace collision::simd
#endif
