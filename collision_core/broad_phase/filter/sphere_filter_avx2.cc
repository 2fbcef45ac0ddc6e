// Eight balls at once. Nothing that others share is included: this file is built for processors
// that not every processor has.
#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"

#if defined(__x86_64__) && COLLISION_WIDE_BITS >= 256
#include <immintrin.h>

#define WIDE __attribute__((target("avx2")))

namespace collision::broad_phase {
namespace {

using Lanes = __m256;
constexpr std::uint32_t kWidth = 8;

WIDE inline Lanes Load(const float* values) { return _mm256_loadu_ps(values); }
WIDE inline Lanes All(float value) { return _mm256_set1_ps(value); }
WIDE inline Lanes Lesser(Lanes a, Lanes b) { return _mm256_min_ps(a, b); }
WIDE inline Lanes Greater(Lanes a, Lanes b) { return _mm256_max_ps(a, b); }
WIDE inline unsigned Mask(Lanes lanes) { return static_cast<unsigned>(_mm256_movemask_ps(lanes)); }
WIDE inline unsigned NotGreater(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NGT_UQ)); }
WIDE inline unsigned NotLess(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NLT_UQ)); }
WIDE inline unsigned NotAtLeast(Lanes a, Lanes b) { return Mask(_mm256_cmp_ps(a, b, _CMP_NGE_UQ)); }

inline void Tell(unsigned mask, std::uint32_t asker, std::uint32_t k, PointHits hits,
                 std::uint32_t* count) {
  for (; mask != 0; mask &= mask - 1) {
    hits.asker[*count] = asker;
    hits.other[(*count)++] = k + static_cast<unsigned>(__builtin_ctz(mask));
  }
}

}  // namespace
}  // namespace collision::broad_phase

#include "collision_core/broad_phase/filter/sphere_filter_wide.h"

namespace collision::broad_phase {

SphereFilter Avx2SphereFilter() { return __builtin_cpu_supports("avx2") ? &Scan : nullptr; }
PointFilter Avx2PointFilter() { return __builtin_cpu_supports("avx2") ? &ScanPoints : nullptr; }

}  // namespace collision::broad_phase

#else

namespace collision::broad_phase {

SphereFilter Avx2SphereFilter() { return nullptr; }
PointFilter Avx2PointFilter() { return nullptr; }

}  // namespace collision::broad_phase

#endif
