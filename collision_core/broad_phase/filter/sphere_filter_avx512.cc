// Sixteen balls at once. Nothing that others share is included: this file is built for processors
// that not every processor has.
#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 512
#include <immintrin.h>

#define WIDE __attribute__((target("avx512f")))

namespace collision::broad_phase {
namespace {

using Lanes = __m512;
constexpr std::uint32_t kWidth = 16;

// The plain minimum and maximum are the same, but g++ 12 takes their unused lanes for a mistake.
constexpr __mmask16 kAll = 0xffff;

WIDE inline Lanes Load(const float* values) { return _mm512_loadu_ps(values); }
WIDE inline Lanes All(float value) { return _mm512_set1_ps(value); }
WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm512_maskz_min_ps(kAll, a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm512_maskz_max_ps(kAll, a, b); }
WIDE inline unsigned NotGreater(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }
WIDE inline unsigned NotLess(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NLT_UQ); }
WIDE inline unsigned NotAtLeast(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGE_UQ); }

// Without a branch: whole vectors are stored, of which the hits count.
WIDE inline void Tell(unsigned mask, std::uint32_t asker, std::uint32_t k, PointHits hits,
                      std::uint32_t* count) {
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i others = _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(k)), lane);
  _mm512_storeu_si512(hits.other + *count,
                      _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), others));
  _mm512_storeu_si512(hits.asker + *count, _mm512_set1_epi32(static_cast<int>(asker)));
  *count += static_cast<unsigned>(__builtin_popcount(mask));
}

}  // namespace
}  // namespace collision::broad_phase

#include "collision_core/broad_phase/filter/sphere_filter_wide.h"

namespace collision::broad_phase {

SphereFilter Avx512SphereFilter() { return __builtin_cpu_supports("avx512f") ? &Scan : nullptr; }
PointFilter Avx512PointFilter() {
  return __builtin_cpu_supports("avx512f") ? &ScanPoints : nullptr;
}

}  // namespace collision::broad_phase

#else

namespace collision::broad_phase {

SphereFilter Avx512SphereFilter() { return nullptr; }
PointFilter Avx512PointFilter() { return nullptr; }

}  // namespace collision::broad_phase

#endif
