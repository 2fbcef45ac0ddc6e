// Eight pairs at once. Nothing that others share is included: this file is built for processors
// that not every processor has.
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 256
#include <immintrin.h>

#define WIDE __attribute__((target("avx2")))

namespace collision::narrow_phase {
namespace {

using Lanes = __m256;
constexpr std::uint32_t kWidth = 8;

WIDE inline Lanes All(float value) { return _mm256_set1_ps(value); }
WIDE inline Lanes Load(const float* values) { return _mm256_loadu_ps(values); }
WIDE inline Lanes OfEight(const float* values) { return _mm256_loadu_ps(values); }
WIDE inline Lanes OfFour(const float* values) {
  return _mm256_broadcast_ps(reinterpret_cast<const __m128*>(values));
}
WIDE inline Lanes RowsOfEight(const float* values, std::uint32_t row, std::uint32_t) {
  return _mm256_broadcast_ss(values + row);
}
WIDE inline Lanes RowsOfFour(const float* values, std::uint32_t row) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_broadcast_ss(values + row)),
                              _mm_broadcast_ss(values + row + 1), 1);
}
WIDE inline void Store(float* to, Lanes lanes) { _mm256_storeu_ps(to, lanes); }
WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm256_min_ps(a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm256_max_ps(a, b); }
WIDE inline Lanes Root(Lanes a) { return _mm256_sqrt_ps(a); }
WIDE inline float Least(Lanes a) {
  __m128 least = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
  least = _mm_min_ps(least, _mm_movehl_ps(least, least));
  return _mm_cvtss_f32(_mm_min_ss(least, _mm_shuffle_ps(least, least, 1)));
}
WIDE inline unsigned NotGreater(Lanes a, Lanes b) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_NGT_UQ)));
}
WIDE inline Lanes Beyond(Lanes a, Lanes b) {
  return _mm256_blendv_ps(All(sphere_tree::kNowhere), a, _mm256_cmp_ps(a, b, _CMP_GT_OQ));
}

}  // namespace
}  // namespace collision::narrow_phase

#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel_wide.h"

namespace collision::narrow_phase {

const SpherePairKernel* Avx2SpherePairKernel() {
  return __builtin_cpu_supports("avx2") ? &kPackScan : nullptr;
}

}  // namespace collision::narrow_phase

#else

namespace collision::narrow_phase {

const SpherePairKernel* Avx2SpherePairKernel() { return nullptr; }

}  // namespace collision::narrow_phase

#endif
