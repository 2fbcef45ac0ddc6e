// Which points of many lie within reach of each other: one pass over a grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/point_scan.h"
#include "collision_core/numeric/rounding.h"

namespace collision {

/// A place and how far from it something reaches.
struct ReachPoint {
  double c[3];
  float reach;
};

/// The box around points, and the farthest reach.
struct PointExtent {
  double low[3] = {kInfinity, kInfinity, kInfinity}, high[3] = {-kInfinity, -kInfinity, -kInfinity};
  float reach = 0;

  void Add(const ReachPoint& point) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point.c[axis]);
      high[axis] = std::max(high[axis], point.c[axis]);
    }
    reach = std::max(reach, point.reach);
  }
};

/// A grid for one question about many points of like reach, evenly spread: nothing is kept for a
/// later one, so that each costs no more than it must: sixteen bytes in the order of the cells.
/// Cells that lie side by side along x do so in memory as well, and are scanned as one range.
class PointGrid {
 public:
  /// `at(k)` gives the k-th ReachPoint, and is asked once.
  /// False: the points do not suit a grid, as they crowd in few of its cells, or its rows would be
  /// too long. The extent may be larger than it need be.
  template <typename At>
  bool Build(std::uint32_t count, const PointExtent& extent, At at);

  std::uint32_t point(std::uint32_t place) const { return order_[place]; }

  /// Calls visit(k, l) with the places of each two that may be within the sum of their reaches, once.
  template <typename Visit>
  void ForEachPair(Visit visit);

  /// Counted since the start.
  std::uint64_t tests() const { return tests_; }
  std::uint64_t ranges() const { return range_count_; }

 private:
  /// A cell, and its neighbours that come after it in the order of rows: so many rows.
  static constexpr int kRangesMax = 5;

  struct Entry {
    float x, y, z, reach;
  };

  bool ChooseCells(std::uint32_t count, const PointExtent& extent);
  /// From counts of the cells to their begins; false: they are crowded.
  bool SumCells(std::uint32_t count);
  void Reserve(std::uint32_t count);
  std::int32_t CellOf(double x, int axis) const {
    // Held within the box, and towards zero: monotone is all that counts.
    const double index = (x - origin_[axis]) * per_cell_;
    return static_cast<std::int32_t>(std::min(std::max(index, 0.0), cell_last_[axis]));
  }

  double origin_[3] = {}, cell_last_[3] = {};
  double cell_ = 0, per_cell_ = 0;
  float reach_most_ = 0, lost_ = 0;
  std::int32_t cells_[3] = {};
  std::vector<std::uint32_t> begin_;    // by cell, and two more
  std::vector<Entry> entries_;          // by point
  std::vector<std::uint32_t> cell_of_;  // by point
  std::vector<std::uint32_t> order_;    // by place: its point
  std::vector<float> floats_;           // four arrays, by place
  std::size_t stride_ = 0;
  std::vector<std::uint32_t> hits_;
  std::uint64_t tests_ = 0, range_count_ = 0;
};

template <typename At>
bool PointGrid::Build(std::uint32_t count, const PointExtent& extent, At at) {
  if (!ChooseCells(count, extent)) return false;
  Reserve(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const ReachPoint point = at(k);
    const std::int32_t x = CellOf(point.c[0], 0), y = CellOf(point.c[1], 1),
                       z = CellOf(point.c[2], 2);
    // As seen from the corner of the row.
    entries_[k] = {static_cast<float>(point.c[0] - origin_[0]),
                   static_cast<float>(point.c[1] - (origin_[1] + y * cell_)),
                   static_cast<float>(point.c[2] - (origin_[2] + z * cell_)),
                   point.reach * (1 + 0x1p-20f) + lost_};
    cell_of_[k] = static_cast<std::uint32_t>((z * cells_[1] + y) * cells_[0] + x);
    ++begin_[cell_of_[k] + 2];
  }
  if (!SumCells(count)) return false;
  for (std::uint32_t k = 0; k < count; ++k) order_[begin_[cell_of_[k] + 1]++] = k;
  float* const x = floats_.data();
  float *const y = x + stride_, *const z = y + stride_, *const reach = z + stride_;
  for (std::uint32_t place = 0; place < count; ++place) {
    const Entry& entry = entries_[order_[place]];
    x[place] = entry.x, y[place] = entry.y, z[place] = entry.z, reach[place] = entry.reach;
  }
  return true;
}

template <typename Visit>
void PointGrid::ForEachPair(Visit visit) {
  const PointScan scan = WidestPointScan();
  const float* const x = floats_.data();
  const float *const y = x + stride_, *const z = y + stride_, *const reach = z + stride_;
  const PointView view{x, y, z, reach};
  const auto cell = static_cast<float>(cell_), per_cell = static_cast<float>(per_cell_);
  const auto last_x = static_cast<float>(cell_last_[0]);
  // The whole number below.
  const auto below = [](float value) {
    const auto whole = static_cast<std::int32_t>(value);
    return whole - (static_cast<float>(whole) > value);
  };
  LaneRange near[kRangesMax];
  const bool one_row = cells_[1] == 1 && cells_[2] == 1;
  std::uint32_t place = 0;
  std::int32_t row = 0;
  for (std::int32_t cz = 0; cz < cells_[2]; ++cz) {
    for (std::int32_t cy = 0; cy < cells_[1]; ++cy, ++row) {
      const std::uint32_t end = begin_[static_cast<std::size_t>(row + 1) * cells_[0]];
      const std::int32_t y_before = std::min(cy, 1), y_after = std::min(cells_[1] - 1 - cy, 1);
      const std::int32_t z_after = std::min(cells_[2] - 1 - cz, 1);
      for (; place < end; ++place) {
        LaneRange* range = near;
        const auto add = [&](std::uint32_t from, std::uint32_t to, float from_y, float from_z) {
          if (from >= to) return;
          *range++ = {from, to, x[place], y[place] - from_y, z[place] - from_z};
          tests_ += to - from;
        };
        // A cell is as wide as two reaches at least: what is near lies in cells side by side.
        const float half = reach[place] + reach_most_;
        const auto x_to = static_cast<std::int32_t>(std::min((x[place] + half) * per_cell, last_x));
        if (one_row) {
          add(place + 1, begin_[static_cast<std::size_t>(x_to) + 1], 0, 0);
        } else {
          const auto x_from =
              static_cast<std::int32_t>(std::max((x[place] - half) * per_cell, 0.0f));
          const std::int32_t y_from = std::max(below((y[place] - half) * per_cell), -y_before);
          const std::int32_t y_to = std::min(below((y[place] + half) * per_cell), y_after);
          const std::int32_t z_to = std::min(below((z[place] + half) * per_cell), z_after);
          for (std::int32_t dz = 0; dz <= z_to; ++dz) {
            for (std::int32_t dy = dz == 0 ? 0 : y_from; dy <= y_to; ++dy) {
              const std::uint32_t* const begin =
                  begin_.data() +
                  static_cast<std::ptrdiff_t>(row + dz * cells_[1] + dy) * cells_[0];
              add(dz == 0 && dy == 0 ? place + 1 : begin[x_from], begin[x_to + 1],
                  static_cast<float>(dy) * cell, static_cast<float>(dz) * cell);
            }
          }
        }
        const auto ranges = static_cast<std::uint32_t>(range - near);
        range_count_ += ranges;
        const std::uint32_t hits = scan(view, reach[place], near, ranges, hits_.data());
        for (std::uint32_t hit = 0; hit < hits; ++hit) visit(place, hits_[hit]);
      }
    }
  }
}

}  // namespace collision
