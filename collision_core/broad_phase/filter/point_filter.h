// Which of many points may lie within reach of a given one: the first look, in wide vectors.
#pragma once

#include <cstdint>

#include "collision_core/broad_phase/filter/sphere_filter.h"

namespace collision::broad_phase {

/// Points in arrays, in single precision: half-way through a time each has its place x, y, z, all
/// of that time it is within `reach` of there, and within `own` of its place + u v at u seconds
/// after half-way. x is as seen from a corner near all of them, y and z from that of the own row of
/// cells. Without velocities places alone are compared.
struct PointView {
  const float *x, *y, *z;
  const float* reach;
  const float *vx = nullptr, *vy = nullptr, *vz = nullptr;
  const float* own = nullptr;
};

/// Up to kAskersMax points [first, last) of one cell that look for others, and what they need to
/// know to look beyond their row of cells.
struct PointAskers {
  std::uint32_t first, last;
  float cell;      ///< How wide a row is.
  float reach;     ///< The farthest of all points.
  float half = 0;  ///< Half of the window [s].
};

inline constexpr std::uint32_t kAskersMax = 8;

/// Points [begin, end) in the row that lies dy, dz of {-1, 0, 1} cells beside the askers'.
struct PointRow {
  std::uint32_t begin, end;
  std::int32_t dy, dz;
};

/// Which two points, by their indices. Room for every test and kLanesMax more.
struct PointHits {
  std::uint32_t *asker, *other;
};

/// How many hits a scan found, and what it cost.
struct PointCounts {
  std::uint32_t hits = 0, tests = 0, ranges = 0;
};

/// For each row, and for each asker that reaches it, writes the points after the asker that come
/// within both reaches, and where there are velocities within both `own` (or where that is not a
/// number), in order. Rounding is SphereFilter's: the caller makes reaches larger by kFilterSlack
/// of themselves and of their way, and by what positions lost. The same hits and counts on every
/// processor.
using PointFilter = PointCounts (*)(const PointView& points, const PointAskers& askers,
                                    const PointRow* rows, std::uint32_t row_count, PointHits hits);

/// The widest that this processor has.
PointFilter WidestPointFilter();

/// Each on its own, for tests; null where the processor or the compiler has none.
PointFilter PlainPointFilter();
PointFilter Avx2PointFilter();
PointFilter Avx512PointFilter();

}  // namespace collision::broad_phase
