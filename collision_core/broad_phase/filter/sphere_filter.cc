#include "collision_core/broad_phase/filter/sphere_filter.h"

#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/simd/lanes_plain.h"

// The kernel comes after its lanes.
#include "collision_core/broad_phase/filter/sphere_filter_wide.h"

namespace collision::broad_phase {
namespace {

template <typename Filter>
Filter Widest(Filter widest, Filter wide, Filter plain) {
  return widest ? widest : wide ? wide : plain;
}

}  // namespace

PointFilter PlainPointFilter() { return &sphere_filter::plain::ScanPoints; }

PointFilter WidestPointFilter() {
  static const PointFilter widest =
      Widest(Avx512PointFilter(), Avx2PointFilter(), PlainPointFilter());
  return widest;
}

SphereFilter PlainSphereFilter() { return &sphere_filter::plain::Scan; }

SphereFilter WidestSphereFilter() {
  static const SphereFilter widest =
      Widest(Avx512SphereFilter(), Avx2SphereFilter(), PlainSphereFilter());
  return widest;
}

}  // namespace collision::broad_phase
