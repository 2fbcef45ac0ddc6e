// Both filters as kernels, for any lanes: only for sphere_filter*.cc, which include a lanes header
// (simd/) first. They give the same hits and counts on every processor.
#pragma once

#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"

namespace collision::broad_phase {
namespace {

using simd::All;
using simd::Greater;
using simd::kWidth;
using simd::Lanes;
using simd::Lesser;
using simd::Load;
using simd::Lowest;
using simd::NotAtLeast;
using simd::NotGreater;
using simd::NotLess;

/// The lanes whose distance is not above the reach.
WIDE inline unsigned Within(Lanes x, Lanes y, Lanes z, Lanes reach) {
  return NotGreater((x * x + y * y) + z * z, reach * reach);
}

/// Moves the differences x, y, z along vx, vy, vz to where the lines are closest, within
/// [first, last].
WIDE inline void ToClosest(Lanes vx, Lanes vy, Lanes vz, Lanes first, Lanes last, Lanes* x,
                           Lanes* y, Lanes* z) {
  const Lanes away = (*x * vx + *y * vy) + *z * vz;
  const Lanes square = (vx * vx + vy * vy) + vz * vz;
  const Lanes u = Lesser(Greater((All(0) - away) / square, first), last);
  *x = *x + vx * u;
  *y = *y + vy * u;
  *z = *z + vz * u;
}

WIDE std::uint32_t Scan(const FilterView& balls, const FilterQuery& query,
                        const FilterRange* ranges, std::uint32_t range_count, std::uint32_t* hits) {
  const Lanes own_vx = All(query.vx), own_vy = All(query.vy), own_vz = All(query.vz);
  const Lanes own_speed = All(query.speed), way = All(query.way);
  const Lanes reach = All(query.reach), time = All(query.time);
  const Lanes first = All(query.first), last = All(query.last);
  std::uint32_t count = 0;
  for (std::uint32_t r = 0; r < range_count; ++r) {
    const FilterRange& range = ranges[r];
    const Lanes at_x = All(range.x), at_y = All(range.y), at_z = All(range.z);
    for (std::uint32_t k = range.begin; k < range.end; k += kWidth) {
      Lanes x = Load(balls.x + k) - at_x, y = Load(balls.y + k) - at_y,
            z = Load(balls.z + k) - at_z;
      const Lanes own =
          Load(balls.s0 + k) + time * (Load(balls.s1 + k) + time * Load(balls.s2 + k));
      const Lanes both = reach + own;
      const Lanes ways = way * (own_speed + Load(balls.speed + k));
      unsigned mask = Lowest(range.end - k) & Within(x, y, z, both + ways);
      if (mask == 0) continue;
      const Lanes vx = Load(balls.vx + k) - own_vx, vy = Load(balls.vy + k) - own_vy,
                  vz = Load(balls.vz + k) - own_vz;
      ToClosest(vx, vy, vz, first, last, &x, &y, &z);
      mask &= Within(x, y, z, both);
      for (; mask != 0; mask &= mask - 1) {
        hits[count++] = k + static_cast<unsigned>(__builtin_ctz(mask));
      }
    }
  }
  return count;
}

/// The query points that reach beyond their row of cells, as bits by point, for each step towards
/// the other row plus one.
struct ReachingPoints {
  unsigned y[3], z[3];
};

WIDE inline ReachingPoints ReachingOf(const PointView& points, const QueryPoints& queries) {
  const std::uint32_t count = queries.last - queries.first;
  const Lanes cell = All(queries.cell), zero = All(0);
  ReachingPoints reaching{{0, (1u << count) - 1, 0}, {0, ~0u, 0}};
  for (std::uint32_t k = 0; k < kQueryPointsMax; k += kWidth) {
    const std::uint32_t first = queries.first + k;
    const unsigned in_group = k < count ? Lowest(count - k) : 0;
    if (in_group == 0) break;
    const Lanes half = Load(points.reach + first) + All(queries.reach);
    const Lanes y = Load(points.y + first), z = Load(points.z + first);
    reaching.y[0] |= (in_group & NotAtLeast(y - half, zero)) << k;
    reaching.y[2] |= (in_group & NotLess(y + half, cell)) << k;
    reaching.z[0] |= (in_group & NotAtLeast(z - half, zero)) << k;
    reaching.z[2] |= (in_group & NotLess(z + half, cell)) << k;
  }
  return reaching;
}

WIDE PointCounts ScanPoints(const PointView& points, const QueryPoints& queries,
                            const PointRow* rows, std::uint32_t row_count, PointHits hits) {
  const ReachingPoints reaching = ReachingOf(points, queries);
  PointCounts counts;
  for (const PointRow* row = rows; row != rows + row_count; ++row) {
    const float row_y = static_cast<float>(row->dy) * queries.cell;
    const float row_z = static_cast<float>(row->dz) * queries.cell;
    for (unsigned left = reaching.y[row->dy + 1] & reaching.z[row->dz + 1]; left != 0;
         left &= left - 1) {
      const std::uint32_t query = queries.first + static_cast<unsigned>(__builtin_ctz(left));
      const std::uint32_t begin = row->begin > query ? row->begin : query + 1;
      if (begin >= row->end) continue;
      counts.tests += row->end - begin;
      ++counts.ranges;
      const Lanes at_x = All(points.x[query]), at_y = All(points.y[query] - row_y),
                  at_z = All(points.z[query] - row_z);
      const Lanes reach = All(points.reach[query]);
      for (std::uint32_t k = begin; k < row->end; k += kWidth) {
        Lanes dx = Load(points.x + k) - at_x, dy = Load(points.y + k) - at_y,
              dz = Load(points.z + k) - at_z;
        const Lanes reaches = reach + Load(points.reach + k);
        unsigned mask = Lowest(row->end - k) & Within(dx, dy, dz, reaches);
        if (mask != 0 && points.own != nullptr) {
          const Lanes vx = Load(points.vx + k) - All(points.vx[query]),
                      vy = Load(points.vy + k) - All(points.vy[query]),
                      vz = Load(points.vz + k) - All(points.vz[query]);
          ToClosest(vx, vy, vz, All(-queries.half), All(queries.half), &dx, &dy, &dz);
          mask &= Within(dx, dy, dz, All(points.own[query]) + Load(points.own + k));
        }
        const std::uint32_t found = simd::StoreSelected(mask, k, hits.other + counts.hits);
        simd::StoreCopies(query, found, hits.query + counts.hits);
        counts.hits += found;
      }
    }
  }
  return counts;
}

}  // namespace
}  // namespace collision::broad_phase
