// Eight balls at once. This file is built for processors that not every machine has, so it includes
// nothing that other files share.
#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"
#include "collision_core/simd/lanes_avx2.h"

#ifdef COLLISION_SIMD
#include "collision_core/broad_phase/filter/sphere_filter_wide.h"
#endif

namespace collision::broad_phase {

#ifdef COLLISION_SIMD

SphereFilter Avx2SphereFilter() {
  return simd::avx2::IsSupported() ? &sphere_filter::avx2::Scan : nullptr;
}
PointFilter Avx2PointFilter() {
  return simd::avx2::IsSupported() ? &sphere_filter::avx2::ScanPoints : nullptr;
}

#else

SphereFilter Avx2SphereFilter() { return nullptr; }
PointFilter Avx2PointFilter() { return nullptr; }

#endif

}  // namespace collision::broad_phase
