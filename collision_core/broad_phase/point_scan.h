// Which of many points may lie within reach of a given one: the first look, in wide vectors.
#pragma once

#include <cstdint>

#include "collision_core/broad_phase/lane_scan.h"

namespace collision {

/// Points in arrays, in single precision, each with its reach; relative to a corner near them.
struct PointView {
  const float *x, *y, *z;
  const float* reach;
};

/// Writes the indices k, range by range and in order, that lie within `reach` and their own of the
/// asker's place (or where that is not a number), and returns how many. `hits` has room for all of
/// the ranges and kLanesMax more. Rounding takes less than 2^-21 of distance and reaches: the caller
/// makes reaches larger by that, and by what positions lost. The same hits on every processor.
using PointScan = std::uint32_t (*)(const PointView& points, float reach, const LaneRange* ranges,
                                    std::uint32_t range_count, std::uint32_t* hits);

/// The widest that this processor has.
PointScan WidestPointScan();

/// Each on its own, for tests; null where the processor or the compiler has none.
PointScan PlainPointScan();
PointScan Avx2PointScan();
PointScan Avx512PointScan();

}  // namespace collision
