// Sixteen pairs at once. Nothing that others share is included: this file is built for processors
// that not every processor has.
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 512
#include <immintrin.h>

#define WIDE __attribute__((target("avx512f,popcnt")))

namespace collision::narrow_phase {
namespace {

using Lanes = __m512;
constexpr std::uint32_t kWidth = 16;

// Plain versions of many operations are the same, but g++ 12 takes their unused lanes for a
// mistake.
constexpr __mmask16 kAll = 0xffff;

WIDE inline Lanes All(float value) { return _mm512_set1_ps(value); }
WIDE inline Lanes Load(const float* values) { return _mm512_loadu_ps(values); }
WIDE inline Lanes OfEight(const float* values) {
  const __m256d eight = _mm256_castps_pd(_mm256_loadu_ps(values));
  return _mm512_castpd_ps(_mm512_maskz_broadcast_f64x4(0xff, eight));
}
WIDE inline Lanes OfFour(const float* values) {
  return _mm512_maskz_broadcast_f32x4(kAll, _mm_loadu_ps(values));
}
WIDE inline Lanes RowsOfEight(const float* values, std::uint32_t row, std::uint32_t next) {
  return _mm512_mask_blend_ps(0xff00, All(values[row]), All(values[next]));
}
WIDE inline Lanes RowsOfFour(const float* values, std::uint32_t) {
  const __m512i lane = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
  return _mm512_maskz_permutexvar_ps(kAll, lane, OfFour(values));
}
WIDE inline void Store(float* to, Lanes lanes) { _mm512_storeu_ps(to, lanes); }
WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm512_maskz_min_ps(kAll, a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm512_maskz_max_ps(kAll, a, b); }
WIDE inline Lanes Root(Lanes a) { return _mm512_maskz_sqrt_ps(kAll, a); }
WIDE inline float Least(Lanes a) {
  const Lanes upper = _mm512_maskz_shuffle_f32x4(kAll, a, a, 0x4e);
  const Lanes least = Lesser(a, upper);
  const __m128 low = _mm512_maskz_extractf32x4_ps(0xff, least, 0);
  const __m128 high = _mm512_maskz_extractf32x4_ps(0xff, least, 1);
  __m128 four = _mm_min_ps(low, high);
  four = _mm_min_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_min_ss(four, _mm_shuffle_ps(four, four, 1)));
}
WIDE inline unsigned NotGreater(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }
WIDE inline Lanes Beyond(Lanes a, Lanes b) {
  return _mm512_mask_blend_ps(_mm512_cmp_ps_mask(a, b, _CMP_GT_OQ), All(sphere_tree::kNowhere), a);
}

}  // namespace
}  // namespace collision::narrow_phase

#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel_wide.h"

namespace collision::narrow_phase {

const SpherePairKernel* Avx512SpherePairKernel() {
  const bool both = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("popcnt");
  return both ? &kPackScan : nullptr;
}

}  // namespace collision::narrow_phase

#else

namespace collision::narrow_phase {

const SpherePairKernel* Avx512SpherePairKernel() { return nullptr; }

}  // namespace collision::narrow_phase

#endif
