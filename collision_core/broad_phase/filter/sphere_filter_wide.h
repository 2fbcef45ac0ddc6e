// Both filters as kernels. After a lanes header (simd/). They give the same hits and counts on
// every processor.
#pragma once

#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"
#include "collision_core/simd/points_wide.h"

namespace collision::broad_phase::sphere_filter::COLLISION_SIMD {

using namespace simd::COLLISION_SIMD;

/// The lanes whose distance is not above the reach.
WIDE inline unsigned Within(const Points& d, const Lanes& reach) {
  return NotGreater(Dot(d, d), reach * reach);
}

/// The differences d + v u where the lines are closest, with u in [first, last].
WIDE inline Points Closest(const Points& d, const Points& v, const Lanes& first,
                           const Lanes& last) {
  const Lanes u = Lesser(Greater((All(0) - Dot(d, v)) / Dot(v, v), first), last);
  return {d.x + v.x * u, d.y + v.y * u, d.z + v.z * u};
}

WIDE inline std::uint32_t Scan(const FilterView& balls, const FilterQuery& query,
                               const FilterRange* ranges, std::uint32_t range_count,
                               std::uint32_t* hits) {
  const Points own_v = {All(query.vx), All(query.vy), All(query.vz)};
  const Lanes own_speed = All(query.speed), u_max = All(query.u_max);
  const Lanes reach = All(query.reach), time = All(query.time);
  const Lanes first = All(query.first), last = All(query.last);
  std::uint32_t count = 0;
  for (std::uint32_t r = 0; r < range_count; ++r) {
    const FilterRange& range = ranges[r];
    const Points at = {All(range.x), All(range.y), All(range.z)};
    for (std::uint32_t k = range.begin; k < range.end; k += kWidth) {
      const Points d = LoadPoints(balls.x + k, balls.y + k, balls.z + k) - at;
      Lanes top = Load(balls.s2 + k);
      if (balls.s3 != nullptr) top = top + time * Load(balls.s3 + k);
      const Lanes own = Load(balls.s0 + k) + time * (Load(balls.s1 + k) + time * top);
      const Lanes both = reach + own;
      const Lanes ways = u_max * (own_speed + Load(balls.speed + k));
      unsigned mask = Lowest(range.end - k) & Within(d, both + ways);
      if (mask == 0) continue;
      const Points v = LoadPoints(balls.vx + k, balls.vy + k, balls.vz + k) - own_v;
      mask &= Within(Closest(d, v, first, last), both);
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

WIDE inline PointCounts ScanPoints(const PointView& points, const QueryPoints& queries,
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
      const Points at = {All(points.x[query]), All(points.y[query] - row_y),
                         All(points.z[query] - row_z)};
      const Lanes reach = All(points.reach[query]);
      for (std::uint32_t k = begin; k < row->end; k += kWidth) {
        const Points d = LoadPoints(points.x + k, points.y + k, points.z + k) - at;
        const Lanes reaches = reach + Load(points.reach + k);
        unsigned mask = Lowest(row->end - k) & Within(d, reaches);
        if (mask != 0 && points.own != nullptr) {
          const Points own_v = {All(points.vx[query]), All(points.vy[query]),
                                All(points.vz[query])};
          const Points v = LoadPoints(points.vx + k, points.vy + k, points.vz + k) - own_v;
          mask &= Within(Closest(d, v, All(-queries.half), All(queries.half)),
                         All(points.own[query]) + Load(points.own + k));
        }
        const std::uint32_t found = StoreSelected(mask, k, hits.other + counts.hits);
        StoreCopies(query, found, hits.query + counts.hits);
        counts.hits += found;
      }
    }
  }
  return counts;
}

}  // namespace collision::broad_phase::sphere_filter::COLLISION_SIMD
