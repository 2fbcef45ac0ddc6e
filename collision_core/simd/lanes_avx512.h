// Sixteen floats: processors with AVX-512F. The dialect is that of lanes_plain.h.
#pragma once

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 512
#include <immintrin.h>

#include <cstdint>

#define COLLISION_SIMD avx512
#define WIDE __attribute__((target("avx512f,popcnt")))
#define WIDE_INLINE WIDE inline __attribute__((always_inline))

namespace collision::simd::avx512 {

inline bool IsSupported() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("popcnt");
}

using Lanes = __m512;
constexpr std::uint32_t kWidth = 16;
constexpr unsigned kAllLanes = (1u << kWidth) - 1;

// The plain versions of many operations are the same, but g++ 12 takes their unused lanes for a
// mistake.
constexpr __mmask16 kUsed = 0xffff;

WIDE inline Lanes Load(const float* values) { return _mm512_loadu_ps(values); }
WIDE inline void Store(float* to, Lanes lanes) { _mm512_storeu_ps(to, lanes); }
WIDE inline Lanes All(float value) { return _mm512_set1_ps(value); }
WIDE inline Lanes LoadEight(const float* values) {
  const __m256d eight = _mm256_castps_pd(_mm256_loadu_ps(values));
  return _mm512_castpd_ps(_mm512_maskz_broadcast_f64x4(0xff, eight));
}
WIDE inline Lanes LoadFour(const float* values) {
  return _mm512_maskz_broadcast_f32x4(kUsed, _mm_loadu_ps(values));
}
WIDE inline Lanes SpreadEights(const float* values, std::uint32_t i, std::uint32_t j) {
  return _mm512_mask_blend_ps(0xff00, All(values[i]), All(values[j]));
}
WIDE inline Lanes SpreadFours(const float* values, std::uint32_t first) {
  const __m512i lane = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
  return _mm512_maskz_permutexvar_ps(kUsed, lane, LoadFour(values + first));
}

WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm512_maskz_min_ps(kUsed, a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm512_maskz_max_ps(kUsed, a, b); }
WIDE inline Lanes Root(Lanes a) { return _mm512_maskz_sqrt_ps(kUsed, a); }
WIDE inline Lanes WhereGreater(Lanes a, Lanes b, Lanes other) {
  return _mm512_mask_blend_ps(_mm512_cmp_ps_mask(a, b, _CMP_GT_OQ), other, a);
}
WIDE inline float LeastOf(Lanes a) {
  const Lanes upper = _mm512_maskz_shuffle_f32x4(kUsed, a, a, 0x4e);
  const Lanes least = Lesser(a, upper);
  const __m128 low = _mm512_maskz_extractf32x4_ps(0xff, least, 0);
  const __m128 high = _mm512_maskz_extractf32x4_ps(0xff, least, 1);
  __m128 four = _mm_min_ps(low, high);
  four = _mm_min_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_min_ss(four, _mm_shuffle_ps(four, four, 1)));
}

WIDE inline unsigned NotGreater(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }
WIDE inline unsigned NotLess(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NLT_UQ); }
WIDE inline unsigned NotAtLeast(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGE_UQ); }
inline unsigned Lowest(std::uint32_t count) {
  return (1u << (count < kWidth ? count : kWidth)) - 1;
}

// Without a branch: whole vectors are stored, of which the selected entries count.
WIDE inline std::uint32_t StoreSelected(unsigned mask, std::uint32_t first, std::uint32_t* to) {
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i indices = _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), lane);
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), indices));
  return static_cast<unsigned>(__builtin_popcount(mask));
}
WIDE inline void StoreCopies(std::uint32_t value, std::uint32_t /*count*/, std::uint32_t* to) {
  _mm512_storeu_si512(to, _mm512_set1_epi32(static_cast<int>(value)));
}

}  // namespace collision::simd::avx512
#endif
