// Which of many points may lie within reach of each other: the filter of PointGrid, in wide
// vectors. It shares its kernels, and so its source files, with SphereFilter (sphere_filter*.cc).
#pragma once

#include <cstdint>

namespace collision::broad_phase {

/// Points in arrays, in single precision (ReachPoint): half-way through the window each is at its
/// place x, y, z; during the window it stays within `reach` of its place, and at u seconds after
/// half-way within `own` of its place + u v. x is as seen from a corner near all of them, y and z
/// as seen from the corner of the point's own row of cells. Without velocities only places are
/// compared.
struct PointView {
  const float *x, *y, *z;
  const float* reach;
  const float *vx = nullptr, *vy = nullptr, *vz = nullptr;
  const float* own = nullptr;
};

/// Up to kQueryPointsMax points [first, last) of one cell, each of which is compared with the
/// points after it in its row of cells and in the rows beside it that it reaches.
struct QueryPoints {
  std::uint32_t first, last;
  float cell;      ///< How wide a row is.
  float reach;     ///< The farthest reach of all points.
  float half = 0;  ///< Half of the window [s].
};

inline constexpr std::uint32_t kQueryPointsMax = 8;

/// Points [begin, end) in the row that lies dy, dz of {-1, 0, 1} cells beside that of the queries.
struct PointRow {
  std::uint32_t begin, end;
  std::int32_t dy, dz;
};

/// The pairs found, by the points' indices: room for as many as tests and kLanesMax more.
struct PointHits {
  std::uint32_t *query, *other;
};

/// How many hits a scan found, and what it cost.
struct PointCounts {
  std::uint32_t hits = 0, tests = 0, ranges = 0;
};

/// For each row, and for each query point that reaches it, writes the points after the query point
/// that come within the sum of both reaches, and where there are velocities within the sum of both
/// `own` (or where that is not a number), in order. Rounding is SphereFilter's: the caller makes
/// each reach larger by kFilterSlack of itself and of its way, and by what positions have lost.
/// Returns the same hits and counts on every processor.
using PointFilter = PointCounts (*)(const PointView& points, const QueryPoints& queries,
                                    const PointRow* rows, std::uint32_t row_count, PointHits hits);

/// The widest version that this processor has.
PointFilter WidestPointFilter();

/// One version each, for tests; null where the processor or the compiler has none.
PointFilter PlainPointFilter();
PointFilter Avx2PointFilter();
PointFilter Avx512PointFilter();

}  // namespace collision::broad_phase
