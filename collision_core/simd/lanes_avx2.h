// Eight floats: processors with AVX2. The dialect is that of lanes_plain.h.
#pragma once

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 256
#include <immintrin.h>

#include <cstdint>

#define COLLISION_SIMD avx2
#define WIDE __attribute__((target("avx2")))
#define WIDE_INLINE WIDE inline __attribute__((always_inline))

namespace collision::simd::avx2 {

inline bool IsSupported() { return __builtin_cpu_supports("avx2"); }

using Lanes = __m256;
constexpr std::uint32_t kWidth = 8;
constexpr unsigned kAllLanes = (1u << kWidth) - 1;

WIDE inline Lanes Load(const float* values) { return _mm256_loadu_ps(values); }
WIDE inline void Store(float* to, Lanes lanes) { _mm256_storeu_ps(to, lanes); }
WIDE inline Lanes All(float value) { return _mm256_set1_ps(value); }
WIDE inline Lanes LoadEight(const float* values) { return _mm256_loadu_ps(values); }
WIDE inline Lanes LoadFour(const float* values) {
  return _mm256_broadcast_ps(reinterpret_cast<const __m128*>(values));
}
WIDE inline Lanes SpreadEights(const float* values, std::uint32_t i, std::uint32_t /*j*/) {
  return _mm256_broadcast_ss(values + i);
}
WIDE inline Lanes SpreadFours(const float* values, std::uint32_t first) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_broadcast_ss(values + first)),
                              _mm_broadcast_ss(values + first + 1), 1);
}

WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm256_min_ps(a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm256_max_ps(a, b); }
WIDE inline Lanes Root(Lanes a) { return _mm256_sqrt_ps(a); }
WIDE inline Lanes WhereGreater(Lanes a, Lanes b, Lanes other) {
  return _mm256_blendv_ps(other, a, _mm256_cmp_ps(a, b, _CMP_GT_OQ));
}
WIDE inline float LeastOf(Lanes a) {
  __m128 least = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
  least = _mm_min_ps(least, _mm_movehl_ps(least, least));
  return _mm_cvtss_f32(_mm_min_ss(least, _mm_shuffle_ps(least, least, 1)));
}

WIDE inline unsigned Mask(Lanes lanes) { return static_cast<unsigned>(_mm256_movemask_ps(lanes)); }
WIDE inline unsigned NotGreater(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NGT_UQ)); }
WIDE inline unsigned NotLess(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NLT_UQ)); }
WIDE inline unsigned NotAtLeast(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NGE_UQ)); }
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

}  // namespace collision::simd::avx2
#endif
