// Agents of similar reach in the cells of a grid.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/broad_phase/filter/placed_balls.h"
#include "collision_core/numeric/allowances.h"

namespace collision::broad_phase {

/// A grid over placed agents of similar reach. A cell is twice as wide as the greatest reach of the
/// first window, or wider where agents are sparse, so that it holds about four; in a crowd smaller
/// cells, down to that width, are tried. Cells that lie side by side along x also lie side by side
/// in memory, in rows that are scanned as one range. If the box around all agents has few cells,
/// the rows are those of the box; else they are short rows of eight cells, found by hashing, so
/// that neither far outliers nor dense clusters cost memory or time. A hash collision costs an
/// extra test and changes no answer.
class GridLevel {
 public:
  /// Builds the grid for the frame's window. Requires an agent. Unchecked: numbers are finite.
  void Build(const PlacementFrame& frame, const PlacedBall* placed, std::uint32_t count,
             const PlacedExtent& extent);

  const PlacedBalls& lanes() const { return lanes_; }
  std::uint32_t size() const { return lanes_.size(); }
  /// The place at which the k-th of the agents given to Build() is kept.
  std::uint32_t place(std::uint32_t k) const { return places_[k]; }
  /// Empties the place.
  void Vacate(std::uint32_t place) { lanes_.Vacate(place); }
  /// No agent of this level comes farther from its place during the window.
  double ReachMax(TimeWindow window) const { return frame_->Reach(most_, window); }
  /// Appends ranges that contain all agents that come within `reach` of `c` during the window. With
  /// `after` given, which is the place of the agent at `c`, only those that come after it in the
  /// order of the cells, so that of two agents one finds the other (both where rows share a place
  /// of the hash). Returns false, and appends none, if that would be more cells than agents.
  bool Ranges(const double* c, double reach, TimeWindow window, std::uint32_t after,
              std::vector<FilterRange>* ranges) const;

  /// Walks the grid: cells follow each other without a gap, each agent that is still there stands
  /// in one of them once, `place(k)` is a permutation. O(N log N). Throws CheckFailure.
  void Validate() const;

  /// About how many rows Ranges() looks at; never more than there are agents.
  double RowsWithin(double reach, TimeWindow window) const;

  /// Whether the rows are those of a box: ForEachPlace() requires it.
  bool in_rows() const { return !hashed_; }

  /// For each place in order, row by row, calls visit(place, query, ranges) with the query of its
  /// ball and the ranges of Ranges(..., place). It returns when the window may end from now on [s].
  template <typename Visit>
  void ForEachPlace(TimeWindow window, Visit visit) const;

 private:
  struct Cell {
    std::int64_t x, y, z;
  };

  /// The whole number at or below x; clamped where x lies beyond any cell.
  static std::int32_t Below(float x) {
    constexpr float kFarthest = 1 << 30;
    const float held = std::min(std::max(x, -kFarthest), kFarthest);
    const auto whole = static_cast<std::int32_t>(held);
    return whole - (static_cast<float>(whole) > held);
  }

  void ChooseCell();
  void ChooseRows();
  void Count(const PlacedBall* placed);
  double Crowding() const;
  void Scatter(const PlacedBall* placed);
  Cell CellOf(double x, double y, double z) const;
  std::uint32_t RowOf(std::int64_t block, std::int64_t y, std::int64_t z) const;

  const PlacementFrame* frame_ = nullptr;
  std::uint32_t size_ = 0;
  PlacedExtent most_;
  double origin_[3] = {}, extent_[3] = {};
  double cell_ = 0, cell_min_ = 0, per_cell_ = 0;
  bool hashed_ = false;
  std::int64_t cells_[3] = {};                 ///< Of the box around all.
  std::int64_t row_cells_ = 0;                 ///< Of one row of the table.
  std::uint32_t rows_ = 0;                     ///< Of the table; a power of two where hashed.
  std::vector<std::uint32_t> begin_;           ///< By cell of the table, and one more.
  std::vector<std::uint32_t> places_, order_;  ///< Place by agent given, and the inverse.
  PlacedBalls lanes_;
};

/// Single precision is enough: the search reaches farther by kBeyond of a cell, which exceeds what
/// it loses.
template <typename Visit>
void GridLevel::ForEachPlace(TimeWindow window, Visit visit) const {
  CORE_CHECK(in_rows(), "the rows of a grid are those of a box");
  constexpr float kBeyond = 0x1p-9f;
  std::vector<FilterRange> ranges;
  const auto cell = static_cast<float>(cell_), per_cell = static_cast<float>(per_cell_);
  const float last_x = static_cast<float>(cells_[0] - 1);
  const std::int32_t cells_y = static_cast<std::int32_t>(cells_[1]);
  FilterQuery times;
  float most;
  const auto set_window = [&] {
    times = TimesOf(*frame_, window);
    most = static_cast<float>(ReachMax(window)) * numeric::kSomeFloatRoundingsUp + cell * kBeyond;
  };
  set_window();
  std::uint32_t place = 0;
  for (std::int32_t z = 0; z < cells_[2]; ++z) {
    for (std::int32_t y = 0; y < cells_y; ++y) {
      const std::int64_t row = static_cast<std::int64_t>(z) * cells_y + y;
      const std::uint32_t end = begin_[static_cast<std::size_t>((row + 1) * row_cells_)];
      for (; place < end; ++place) {
        const FilterQuery query = lanes_.QueryOf(place, times);
        const float half = ReachFromPlace(query) + most;
        const float at[3] = {lanes_.x()[place], lanes_.y()[place], lanes_.z()[place]};
        // Cells relative to the place's own one, clamped to the box; truncated where positive.
        const auto x_from = static_cast<std::int32_t>(std::max((at[0] - half) * per_cell, 0.0f));
        const auto x_to = static_cast<std::int32_t>(std::min((at[0] + half) * per_cell, last_x));
        const std::int32_t y_from = std::max(Below((at[1] - half) * per_cell), -y);
        const std::int32_t y_to = std::min(Below((at[1] + half) * per_cell), cells_y - 1 - y);
        const std::int32_t z_to = std::min(Below((at[2] + half) * per_cell),
                                           static_cast<std::int32_t>(cells_[2]) - 1 - z);
        ranges.clear();
        for (std::int32_t step_z = 0; step_z <= z_to; ++step_z) {
          for (std::int32_t step_y = step_z == 0 ? 0 : y_from; step_y <= y_to; ++step_y) {
            const std::uint32_t* cells =
                begin_.data() + (row + std::int64_t{step_z} * cells_y + step_y) * row_cells_;
            const std::uint32_t first = step_z == 0 && step_y == 0 ? place + 1 : cells[x_from];
            const std::uint32_t last = cells[x_to + 1];
            if (first >= last) continue;
            ranges.push_back({first, last, at[0], at[1] - static_cast<float>(step_y) * cell,
                              at[2] - static_cast<float>(step_z) * cell});
          }
        }
        const double until = visit(place, query, ranges);
        if (until < window.last) {
          window.last = std::max(until, window.first);
          set_window();
        }
      }
    }
  }
}

}  // namespace collision::broad_phase
