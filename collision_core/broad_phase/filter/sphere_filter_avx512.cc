// Sixteen balls at once. This file is built for processors that not every machine has, so it
// includes nothing that other files share.
#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"
#include "collision_core/simd/lanes_avx512.h"

#ifdef COLLISION_SIMD
#include "collision_core/broad_phase/filter/sphere_filter_wide.h"
#endif

namespace collision::broad_phase {

#ifdef COLLISION_SIMD

SphereFilter Avx512SphereFilter() {
  return simd::avx512::IsSupported() ? &sphere_filter::avx512::Scan : nullptr;
}
PointFilter Avx512PointFilter() {
  return simd::avx512::IsSupported() ? &sphere_filter::avx512::ScanPoints : nullptr;
}

#else

SphereFilter Avx512SphereFilter() { return nullptr; }
PointFilter Avx512PointFilter() { return nullptr; }

#endif

}  // namespace collision::broad_phase
