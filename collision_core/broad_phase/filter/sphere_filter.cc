#include "collision_core/broad_phase/filter/sphere_filter.h"

#include "collision_core/broad_phase/filter/point_filter.h"

namespace collision::broad_phase {
namespace {

// As the wide ones: of two, the second where they do not compare.
float Greater(float a, float b) { return a > b ? a : b; }
float Lesser(float a, float b) { return a < b ? a : b; }

// When the lines are closest, within [first, last].
float Closest(float away, float square, float first, float last) {
  return Lesser(Greater((0 - away) / square, first), last);
}

// The order of the operations is that of the wide ones.
std::uint32_t Scan(const FilterView& balls, const FilterQuery& query, const FilterRange* ranges,
                   std::uint32_t range_count, std::uint32_t* hits) {
  std::uint32_t count = 0;
  for (std::uint32_t r = 0; r < range_count; ++r) {
    const FilterRange& range = ranges[r];
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
      const float u = Closest(away, square, query.first, query.last);
      x = x + vx * u, y = y + vy * u, z = z + vz * u;
      const float squared = (x * x + y * y) + z * z;
      hits[count] = k;
      count += !(squared > both * both);
    }
  }
  return count;
}

PointCounts ScanPoints(const PointView& points, const PointAskers& askers, const PointRow* rows,
                       std::uint32_t row_count, PointHits hits) {
  PointCounts counts;
  for (const PointRow* row = rows; row != rows + row_count; ++row) {
    const float row_y = static_cast<float>(row->dy) * askers.cell;
    const float row_z = static_cast<float>(row->dz) * askers.cell;
    for (std::uint32_t asker = askers.first; asker < askers.last; ++asker) {
      const float half = points.reach[asker] + askers.reach;
      if (row->dy < 0 && points.y[asker] - half >= 0) continue;
      if (row->dy > 0 && points.y[asker] + half < askers.cell) continue;
      if (row->dz < 0 && points.z[asker] - half >= 0) continue;
      if (row->dz > 0 && points.z[asker] + half < askers.cell) continue;
      const std::uint32_t begin = row->begin > asker ? row->begin : asker + 1;
      if (begin >= row->end) continue;
      counts.tests += row->end - begin;
      ++counts.ranges;
      const float at_x = points.x[asker], at_y = points.y[asker] - row_y,
                  at_z = points.z[asker] - row_z;
      for (std::uint32_t k = begin; k < row->end; ++k) {
        float x = points.x[k] - at_x, y = points.y[k] - at_y, z = points.z[k] - at_z;
        const float both = points.reach[asker] + points.reach[k];
        if ((x * x + y * y) + z * z > both * both) continue;
        if (points.own != nullptr) {
          const float vx = points.vx[k] - points.vx[asker], vy = points.vy[k] - points.vy[asker],
                      vz = points.vz[k] - points.vz[asker];
          const float u = Closest((x * vx + y * vy) + z * vz, (vx * vx + vy * vy) + vz * vz,
                                  -askers.half, askers.half);
          x = x + vx * u, y = y + vy * u, z = z + vz * u;
          const float near = points.own[asker] + points.own[k];
          if ((x * x + y * y) + z * z > near * near) continue;
        }
        hits.asker[counts.hits] = asker, hits.other[counts.hits++] = k;
      }
    }
  }
  return counts;
}

template <typename Scan>
Scan Widest(Scan widest, Scan wide, Scan plain) {
  return widest ? widest : wide ? wide : plain;
}

}  // namespace

PointFilter PlainPointFilter() { return &ScanPoints; }

PointFilter WidestPointFilter() {
  static const PointFilter widest =
      Widest(Avx512PointFilter(), Avx2PointFilter(), PlainPointFilter());
  return widest;
}

SphereFilter PlainSphereFilter() { return &Scan; }

SphereFilter WidestSphereFilter() {
  static const SphereFilter widest =
      Widest(Avx512SphereFilter(), Avx2SphereFilter(), PlainSphereFilter());
  return widest;
}

}  // namespace collision::broad_phase
