// Agents of like reach in the cells of a grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/lanes.h"

namespace collision {

/// A grid over placed agents. Cells that lie side by side along x also lie side by side in memory,
/// in rows; where the box around all agents has few cells the rows are those of the box, else short
/// ones found by hashing, so that neither far outliers nor dense clusters cost memory or time. Who
/// shares a place in the table with somebody far away by chance costs him one test.
class GridLevel {
 public:
  /// Requires at least one agent, all of them finite. The cells suit the placing's window.
  void Build(const Placing& placing, const PlacedHorn* placed, std::uint32_t count);

  const Lanes& lanes() const { return lanes_; }
  std::uint32_t size() const { return lanes_.size(); }
  /// The place at which the k-th of the agents given to Build() is kept.
  std::uint32_t place(std::uint32_t k) const { return places_[k]; }
  /// Nobody is found there any more.
  void Vacate(std::uint32_t place) { lanes_.Vacate(place); }
  /// Nobody here comes farther from its place.
  double ReachMax(Stretch stretch) const { return placing_->Reach(most_, stretch); }
  /// The cells are so small that a question over the stretch visits many of them.
  bool IsFine(Stretch stretch) const { return cell_ < ReachMax(stretch); }

  /// Appends ranges in which all agents are that come within `reach` of `c` during the stretch.
  /// With `after` given, only those that come after that place in an order of the cells (`c` is
  /// that agent's): of two agents exactly one finds the other. False, and none: that would be more
  /// cells than there are agents.
  bool Ranges(const double* c, double reach, Stretch stretch, std::uint32_t after,
              std::vector<LaneRange>* ranges) const;

  /// The rows are those of a box, and ForEachPlace() can be asked.
  bool in_rows() const { return !hashed_; }

  /// Goes through the places in order, row by row: Ranges(..., place) of each. Calls
  /// visit(place, stretch, ranges), which returns when the stretch may end from now on.
  template <typename Visit>
  void ForEachPlace(Stretch stretch, Visit visit) const;

 private:
  struct Cell {
    std::int64_t x, y, z;
  };

  void Measure(const PlacedHorn* placed);
  void ChooseRows();
  void Count(const PlacedHorn* placed);
  double Crowding() const;
  void Scatter(const PlacedHorn* placed);
  Cell CellOf(double x, double y, double z) const;
  std::uint32_t RowOf(std::int64_t block, std::int64_t y, std::int64_t z) const;

  const Placing* placing_ = nullptr;
  std::uint32_t size_ = 0;
  struct {
    float s0, s1, s2, speed;
  } most_ = {};
  double origin_[3] = {}, extent_[3] = {};
  double cell_ = 0, cell_min_ = 0, per_cell_ = 0;
  bool hashed_ = false;
  std::int64_t cells_[3] = {};                 // of the box around all
  std::int64_t row_cells_ = 0;                 // of one row of the table
  std::uint32_t rows_ = 0;                     // of the table; a power of two where hashed
  std::vector<std::uint32_t> begin_;           // by cell of the table, and one more
  std::vector<std::uint32_t> places_, order_;  // place by agent given, and the other way round
  Lanes lanes_;
};

/// Single precision is enough: what it loses is made up for by a thousandth of a cell.
template <typename Visit>
void GridLevel::ForEachPlace(Stretch stretch, Visit visit) const {
  std::vector<LaneRange> ranges;
  const auto cell = static_cast<float>(cell_), per_cell = static_cast<float>(per_cell_);
  const auto most_after = [&] {
    return static_cast<float>(ReachMax(stretch)) * (1 + 0x1p-20f) + cell * 0x1p-10f;
  };
  float most = most_after();
  const auto across = [&](float at, float half, std::int64_t own, std::int64_t cells, int* from,
                          int* to) {
    // Within the box, and down: counted from a cell that is not above the box's first.
    const auto shift = static_cast<float>(own), most_of_all = static_cast<float>(cells - 1);
    const float low = (at - half) * per_cell + shift, high = (at + half) * per_cell + shift;
    *from = static_cast<int>(std::min(std::max(low, 0.0f), most_of_all)) - static_cast<int>(own);
    *to = static_cast<int>(std::min(std::max(high, 0.0f), most_of_all)) - static_cast<int>(own);
  };
  std::uint32_t place = 0;
  for (std::int64_t z = 0; z < cells_[2]; ++z) {
    for (std::int64_t y = 0; y < cells_[1]; ++y) {
      const std::int64_t row = z * cells_[1] + y;
      const std::uint32_t end = begin_[static_cast<std::size_t>((row + 1) * row_cells_)];
      for (; place < end; ++place) {
        const float half = lanes_.Reach(place, *placing_, stretch) + most;
        const float at_x = lanes_.x()[place], at_y = lanes_.y()[place], at_z = lanes_.z()[place];
        int x[2], dy[2], dz[2];
        across(at_x, half, 0, cells_[0], &x[0], &x[1]);
        across(at_y, half, y, cells_[1], &dy[0], &dy[1]);
        across(at_z, half, z, cells_[2], &dz[0], &dz[1]);
        ranges.clear();
        for (int step_z = 0; step_z <= dz[1]; ++step_z) {
          for (int step_y = step_z == 0 ? 0 : dy[0]; step_y <= dy[1]; ++step_y) {
            const std::int64_t other = row + step_z * cells_[1] + step_y;
            const std::uint32_t* cells = begin_.data() + other * row_cells_;
            const std::uint32_t first =
                step_z == 0 && step_y == 0 ? std::max(cells[x[0]], place + 1) : cells[x[0]];
            const std::uint32_t last = cells[x[1] + 1];
            if (first >= last) continue;
            ranges.push_back({first, last, at_x, at_y - static_cast<float>(step_y) * cell,
                              at_z - static_cast<float>(step_z) * cell});
          }
        }
        const double last = visit(place, stretch, ranges);
        if (last < stretch.last) {
          stretch.last = last;
          most = most_after();
        }
      }
    }
  }
}

}  // namespace collision
