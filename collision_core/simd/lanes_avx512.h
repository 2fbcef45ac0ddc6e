// Sixteen lanes: processors with AVX-512F. The dialect is that of lanes_plain.h.
#pragma once

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 512
#include <immintrin.h>

#include <cstdint>

#define COLLISION_LANES 16
#define WIDE __attribute__((target("avx512f")))

namespace collision::simd {
namespace {

using Lanes = __m512;
constexpr std::uint32_t kWidth = 16;

// The plain minimum, maximum and root are the same, but g++ 12 takes their unused lanes for a
// mistake.
constexpr __mmask16 kAllLanes = 0xffff;

WIDE inline Lanes Load(const float* values) { return _mm512_loadu_ps(values); }
WIDE inline void Store(float* to, Lanes lanes) { _mm512_storeu_ps(to, lanes); }
WIDE inline Lanes All(float value) { return _mm512_set1_ps(value); }
WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm512_maskz_min_ps(kAllLanes, a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm512_maskz_max_ps(kAllLanes, a, b); }
WIDE inline Lanes Root(Lanes a) { return _mm512_maskz_sqrt_ps(kAllLanes, a); }
WIDE inline unsigned NotGreater(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }
WIDE inline unsigned NotLess(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NLT_UQ); }
WIDE inline unsigned NotAtLeast(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGE_UQ); }

/// A mask of the first `count` lanes, or of all.
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

}  // namespace
}  // namespace collision::simd
#endif
