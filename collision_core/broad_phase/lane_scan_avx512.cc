// Sixteen balls at once. Nothing that others share is included: this file is built for processors
// that not everybody has.
#include "collision_core/broad_phase/lane_scan.h"
#include "collision_core/broad_phase/point_scan.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace collision {

#ifdef __x86_64__
namespace {

using Lanes = __m512;

// The plain minimum and maximum are the same, but g++ 12 takes their unused lanes for a mistake.
constexpr __mmask16 kAll = 0xffff;

// The lanes of a range's last vector that are still in it.
inline unsigned Lowest(std::uint32_t count) { return count < 16 ? (1u << count) - 1 : ~0u; }

inline std::uint32_t Tell(unsigned mask, std::uint32_t k, std::uint32_t* hits,
                          std::uint32_t count) {
  for (; mask != 0; mask &= mask - 1) {
    hits[count++] = k + static_cast<unsigned>(__builtin_ctz(mask));
  }
  return count;
}

__attribute__((target("avx512f"))) inline unsigned Within(Lanes x, Lanes y, Lanes z, Lanes reach) {
  const Lanes squared =
      _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y)), _mm512_mul_ps(z, z));
  return _mm512_cmp_ps_mask(squared, _mm512_mul_ps(reach, reach), _CMP_NGT_UQ);
}

// Moves the differences x, y, z along vx, vy, vz to where the lines are closest, within [first, last].
__attribute__((target("avx512f"))) inline void ToClosest(Lanes vx, Lanes vy, Lanes vz, Lanes first,
                                                         Lanes last, Lanes* x, Lanes* y, Lanes* z) {
  const Lanes away = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(*x, vx), _mm512_mul_ps(*y, vy)),
                                   _mm512_mul_ps(*z, vz));
  const Lanes square = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(vx, vx), _mm512_mul_ps(vy, vy)),
                                     _mm512_mul_ps(vz, vz));
  const Lanes free = _mm512_div_ps(_mm512_sub_ps(_mm512_setzero_ps(), away), square);
  const Lanes u = _mm512_maskz_min_ps(kAll, _mm512_maskz_max_ps(kAll, free, first), last);
  *x = _mm512_add_ps(*x, _mm512_mul_ps(vx, u));
  *y = _mm512_add_ps(*y, _mm512_mul_ps(vy, u));
  *z = _mm512_add_ps(*z, _mm512_mul_ps(vz, u));
}

__attribute__((target("avx512f"))) std::uint32_t Scan(const LaneView& balls, const LaneQuery& query,
                                                      const LaneRange* ranges,
                                                      std::uint32_t range_count,
                                                      std::uint32_t* hits) {
  const Lanes own_vx = _mm512_set1_ps(query.vx), own_vy = _mm512_set1_ps(query.vy),
              own_vz = _mm512_set1_ps(query.vz);
  const Lanes own_speed = _mm512_set1_ps(query.speed), way = _mm512_set1_ps(query.way);
  const Lanes reach = _mm512_set1_ps(query.reach), time = _mm512_set1_ps(query.time);
  const Lanes first = _mm512_set1_ps(query.first), last = _mm512_set1_ps(query.last);
  std::uint32_t count = 0;
  for (std::uint32_t r = 0; r < range_count; ++r) {
    const LaneRange& range = ranges[r];
    const Lanes at_x = _mm512_set1_ps(range.x), at_y = _mm512_set1_ps(range.y),
                at_z = _mm512_set1_ps(range.z);
    for (std::uint32_t k = range.begin; k < range.end; k += 16) {
      Lanes x = _mm512_sub_ps(_mm512_loadu_ps(balls.x + k), at_x);
      Lanes y = _mm512_sub_ps(_mm512_loadu_ps(balls.y + k), at_y);
      Lanes z = _mm512_sub_ps(_mm512_loadu_ps(balls.z + k), at_z);
      const Lanes slope = _mm512_add_ps(_mm512_loadu_ps(balls.s1 + k),
                                        _mm512_mul_ps(time, _mm512_loadu_ps(balls.s2 + k)));
      const Lanes own = _mm512_add_ps(_mm512_loadu_ps(balls.s0 + k), _mm512_mul_ps(time, slope));
      const Lanes both = _mm512_add_ps(reach, own);
      const Lanes ways =
          _mm512_mul_ps(way, _mm512_add_ps(own_speed, _mm512_loadu_ps(balls.speed + k)));
      unsigned mask = Lowest(range.end - k) & Within(x, y, z, _mm512_add_ps(both, ways));
      if (mask == 0) continue;
      const Lanes vx = _mm512_sub_ps(_mm512_loadu_ps(balls.vx + k), own_vx);
      const Lanes vy = _mm512_sub_ps(_mm512_loadu_ps(balls.vy + k), own_vy);
      const Lanes vz = _mm512_sub_ps(_mm512_loadu_ps(balls.vz + k), own_vz);
      ToClosest(vx, vy, vz, first, last, &x, &y, &z);
      mask &= Within(x, y, z, both);
      count = Tell(mask, k, hits, count);
    }
  }
  return count;
}

// The askers for whom a - b is not >= c.
__attribute__((target("avx512f"))) inline unsigned Below(Lanes a, Lanes b, Lanes c) {
  return _mm512_cmp_ps_mask(_mm512_sub_ps(a, b), c, _CMP_NGE_UQ);
}

// The askers for whom a + b is not < c.
__attribute__((target("avx512f"))) inline unsigned Beyond(Lanes a, Lanes b, Lanes c) {
  return _mm512_cmp_ps_mask(_mm512_add_ps(a, b), c, _CMP_NLT_UQ);
}

__attribute__((target("avx512f"))) PointCounts ScanPoints(const PointView& points,
                                                          const PointAskers& askers,
                                                          const PointRow* rows,
                                                          std::uint32_t row_count, PointHits hits) {
  const Lanes half =
      _mm512_add_ps(_mm512_loadu_ps(points.reach + askers.first), _mm512_set1_ps(askers.reach));
  const Lanes y = _mm512_loadu_ps(points.y + askers.first);
  const Lanes z = _mm512_loadu_ps(points.z + askers.first);
  const Lanes cell = _mm512_set1_ps(askers.cell), zero = _mm512_setzero_ps();
  const unsigned who = Lowest(askers.last - askers.first);
  const unsigned in_y[3] = {who & Below(y, half, zero), who, who & Beyond(y, half, cell)};
  const unsigned in_z[3] = {Below(z, half, zero), ~0u, Beyond(z, half, cell)};
  PointCounts counts;
  for (const PointRow* row = rows; row != rows + row_count; ++row) {
    for (unsigned left = in_y[row->dy + 1] & in_z[row->dz + 1]; left != 0; left &= left - 1) {
      const std::uint32_t asker = askers.first + static_cast<unsigned>(__builtin_ctz(left));
      const std::uint32_t begin = row->begin > asker ? row->begin : asker + 1;
      if (begin >= row->end) continue;
      counts.tests += row->end - begin;
      ++counts.ranges;
      const Lanes at_x = _mm512_set1_ps(points.x[asker]);
      const Lanes at_y =
          _mm512_set1_ps(points.y[asker] - static_cast<float>(row->dy) * askers.cell);
      const Lanes at_z =
          _mm512_set1_ps(points.z[asker] - static_cast<float>(row->dz) * askers.cell);
      const Lanes own = _mm512_set1_ps(points.reach[asker]);
      for (std::uint32_t k = begin; k < row->end; k += 16) {
        Lanes dx = _mm512_sub_ps(_mm512_loadu_ps(points.x + k), at_x);
        Lanes dy = _mm512_sub_ps(_mm512_loadu_ps(points.y + k), at_y);
        Lanes dz = _mm512_sub_ps(_mm512_loadu_ps(points.z + k), at_z);
        const Lanes both = _mm512_add_ps(own, _mm512_loadu_ps(points.reach + k));
        unsigned mask = Lowest(row->end - k) & Within(dx, dy, dz, both);
        if (mask != 0 && points.own != nullptr) {
          const Lanes vx =
              _mm512_sub_ps(_mm512_loadu_ps(points.vx + k), _mm512_set1_ps(points.vx[asker]));
          const Lanes vy =
              _mm512_sub_ps(_mm512_loadu_ps(points.vy + k), _mm512_set1_ps(points.vy[asker]));
          const Lanes vz =
              _mm512_sub_ps(_mm512_loadu_ps(points.vz + k), _mm512_set1_ps(points.vz[asker]));
          ToClosest(vx, vy, vz, _mm512_set1_ps(-askers.half), _mm512_set1_ps(askers.half), &dx, &dy,
                    &dz);
          mask &= Within(
              dx, dy, dz,
              _mm512_add_ps(_mm512_set1_ps(points.own[asker]), _mm512_loadu_ps(points.own + k)));
        }
        const __m512i places = _mm512_add_epi32(
            _mm512_set1_epi32(static_cast<int>(k)),
            _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
        _mm512_storeu_si512(hits.other + counts.hits,
                            _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), places));
        _mm512_storeu_si512(hits.asker + counts.hits, _mm512_set1_epi32(static_cast<int>(asker)));
        counts.hits += static_cast<unsigned>(__builtin_popcount(mask));
      }
    }
  }
  return counts;
}

}  // namespace

LaneScan Avx512LaneScan() { return __builtin_cpu_supports("avx512f") ? &Scan : nullptr; }

PointScan Avx512PointScan() { return __builtin_cpu_supports("avx512f") ? &ScanPoints : nullptr; }
#else
PointScan Avx512PointScan() { return nullptr; }
LaneScan Avx512LaneScan() { return nullptr; }
#endif

}  // namespace collision
