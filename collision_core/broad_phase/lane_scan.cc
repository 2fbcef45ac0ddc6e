#include "collision_core/broad_phase/lane_scan.h"

#include "collision_core/broad_phase/point_scan.h"

namespace collision {
namespace {

// As the wide ones: of two, the second where they do not compare.
float Greater(float a, float b) { return a > b ? a : b; }
float Lesser(float a, float b) { return a < b ? a : b; }

// The order of the operations is that of the wide ones.
std::uint32_t Scan(const LaneView& balls, const LaneQuery& query, const LaneRange* ranges,
                   std::uint32_t range_count, std::uint32_t* hits) {
  std::uint32_t count = 0;
  for (std::uint32_t r = 0; r < range_count; ++r) {
    const LaneRange& range = ranges[r];
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      float x = balls.x[k] - range.x, y = balls.y[k] - range.y, z = balls.z[k] - range.z;
      const float own = balls.s0[k] + query.time * (balls.s1[k] + query.time * balls.s2[k]);
      const float both = query.reach + own;
      const float wide = both + query.way * (query.speed + balls.speed[k]);
      if ((x * x + y * y) + z * z > wide * wide) continue;
      const float vx = balls.vx[k] - query.vx, vy = balls.vy[k] - query.vy,
                  vz = balls.vz[k] - query.vz;
      const float away = (x * vx + y * vy) + z * vz;
      const float square = (vx * vx + vy * vy) + vz * vz;
      const float u = Lesser(Greater((0 - away) / square, query.first), query.last);
      x = x + vx * u, y = y + vy * u, z = z + vz * u;
      const float squared = (x * x + y * y) + z * z;
      hits[count] = k;
      count += !(squared > both * both);
    }
  }
  return count;
}

std::uint32_t ScanPoints(const PointView& points, float reach, const LaneRange* ranges,
                         std::uint32_t range_count, std::uint32_t* hits) {
  std::uint32_t count = 0;
  for (std::uint32_t r = 0; r < range_count; ++r) {
    const LaneRange& range = ranges[r];
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const float x = points.x[k] - range.x, y = points.y[k] - range.y, z = points.z[k] - range.z;
      const float both = reach + points.reach[k];
      hits[count] = k;
      count += !((x * x + y * y) + z * z > both * both);
    }
  }
  return count;
}

template <typename Scan>
Scan Widest(Scan widest, Scan wide, Scan plain) {
  return widest ? widest : wide ? wide : plain;
}

}  // namespace

PointScan PlainPointScan() { return &ScanPoints; }

PointScan WidestPointScan() {
  static const PointScan widest = Widest(Avx512PointScan(), Avx2PointScan(), PlainPointScan());
  return widest;
}

LaneScan PlainLaneScan() { return &Scan; }

LaneScan WidestLaneScan() {
  static const LaneScan widest = Widest(Avx512LaneScan(), Avx2LaneScan(), PlainLaneScan());
  return widest;
}

}  // namespace collision
