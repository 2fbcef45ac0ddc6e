#include "collision_core/broad_phase/index/grid_level.h"

#include <algorithm>
#include <cmath>

#include "collision_core/numeric/cube_root.h"

namespace collision::broad_phase {
namespace {

/// Agents in a cell of an evenly filled grid, so that rows of three cells fill a wide vector.
constexpr double kPerCell = 4;

/// Up to this number all agents share one cell.
constexpr std::uint32_t kListMax = 32;

/// The most cells of the box around all, per agent; beyond it rows are found by hashing.
constexpr double kCellsPerAgent = 4;

/// Longer rows would cost too many digits of a position.
constexpr double kRowCellsMax = 4096;

constexpr int kHashedRowShift = 3;

/// The most agents that an agent may find in its own cell, on average, before smaller cells are
/// tried; how much smaller, and how often.
constexpr double kCrowdingMax = 4 * kPerCell;
constexpr double kCellShrink = 8;
constexpr int kCellTriesMax = 12;

/// What rounding takes from a position stored in single precision, for the two agents of a pair, as
/// a part of the row's length: each loses at most 2^-24 of it on each axis, so both together lose
/// less than 2 · √3 · 2^-24 < 2^-22 of it; twice that is allowed.
constexpr double kStoredPositionLoss = 0x1p-21;

/// Cells are looked up for a little more than both reaches: positions, sums and the division by the
/// cell's width lose less than 2^-49 of the terms each.
constexpr double kRangeSlack = 1 + 0x1p-20;

/// Cells further out share the outermost one.
constexpr double kCellIndexMax = 0x1p+50;

double Root(double a, int degree) {
  return degree == 1 ? a : degree == 2 ? std::sqrt(a) : numeric::CubeRoot(a);
}

}  // namespace

inline GridLevel::Cell GridLevel::CellOf(double x, double y, double z) const {
  const double at[3] = {x, y, z};
  std::int64_t cell[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double index = (at[axis] - origin_[axis]) * per_cell_;
    // Rounded down, or towards zero and clamped to the box; the search only needs it to be
    // monotone.
    if (hashed_) {
      const double held = std::clamp(index, -kCellIndexMax, kCellIndexMax);
      cell[axis] = static_cast<std::int64_t>(held);
      cell[axis] -= static_cast<double>(cell[axis]) > held;
    } else {
      cell[axis] = static_cast<std::int64_t>(
          std::min(std::max(index, 0.0), static_cast<double>(cells_[axis] - 1)));
    }
  }
  return {cell[0], cell[1], cell[2]};
}

void GridLevel::Build(const PlacementFrame& frame, const PlacedBall* placed, std::uint32_t count,
                      const PlacedExtent& extent) {
  CORE_CHECK(count > 0, "a level has agents");
  frame_ = &frame;
  size_ = count;
  most_ = extent;
  ChooseCell();
  for (int tries = 0;; ++tries) {
    ChooseRows();
    Count(placed);
    if (size_ <= kListMax || cell_ <= cell_min_ || tries == kCellTriesMax) break;
    if (Crowding() <= kCrowdingMax) break;
    cell_ = std::max(cell_min_, cell_ / kCellShrink);
  }
  Scatter(placed);
}

void GridLevel::ChooseCell() {
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    origin_[axis] = most_.low[axis];
    extent_[axis] = most_.high[axis] - most_.low[axis];
    widest = std::max(widest, extent_[axis]);
  }
  cell_min_ = 2 * ReachMax({0, frame_->window()});
  if (size_ <= kListMax) {
    cell_ = std::max(cell_min_, 2 * widest);
    return;
  }
  // Aims at kPerCell agents a cell; axes along which all agents fit into one cell do not count.
  double cell = widest;
  for (int dimensions = 3; dimensions > 0; --dimensions) {
    double volume = 1;
    int wide = 0;
    for (const double extent : extent_) {
      if (extent <= 0 || (dimensions < 3 && extent < cell)) continue;
      volume *= extent;
      ++wide;
    }
    if (wide == 0) break;
    const double next = Root(volume * kPerCell / size_, wide);
    const bool settled = std::all_of(std::begin(extent_), std::end(extent_), [&](double extent) {
      return extent <= 0 || extent >= next || (dimensions < 3 && extent < cell);
    });
    cell = next;
    if (settled) break;
  }
  cell_ = std::max(cell_min_, cell);
}

void GridLevel::ChooseRows() {
  per_cell_ = 1 / cell_;
  double total = 1;
  for (int axis = 0; axis < 3; ++axis) total *= std::floor(extent_[axis] * per_cell_) + 1;
  hashed_ = total > kCellsPerAgent * size_ + 64 || extent_[0] * per_cell_ > kRowCellsMax;
  if (hashed_) {
    row_cells_ = std::int64_t{1} << kHashedRowShift;
    rows_ = 1;
    while (rows_ * kPerCell < size_) rows_ *= 2;
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    cells_[axis] = static_cast<std::int64_t>(extent_[axis] * per_cell_) + 1;
  }
  row_cells_ = cells_[0];
  rows_ = static_cast<std::uint32_t>(cells_[1] * cells_[2]);
}

std::uint32_t GridLevel::RowOf(std::int64_t block, std::int64_t y, std::int64_t z) const {
  if (!hashed_) return static_cast<std::uint32_t>(z * cells_[1] + y);
  std::uint64_t h = static_cast<std::uint64_t>(block) * 0x9e3779b97f4a7c15u;
  h ^= static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu;
  h ^= static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u;
  h ^= h >> 29;
  h *= 0xbf58476d1ce4e5b9u;
  return static_cast<std::uint32_t>(h >> 32) & (rows_ - 1);
}

// Finds the cell of each agent, and how many agents are in each.
void GridLevel::Count(const PlacedBall* placed) {
  begin_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(row_cells_) + 2, 0);
  places_.resize(size_);
  for (std::uint32_t k = 0; k < size_; ++k) {
    const Cell cell = CellOf(placed[k].c[0], placed[k].c[1], placed[k].c[2]);
    const std::int64_t block = hashed_ ? cell.x >> kHashedRowShift : 0;
    const auto in_row = static_cast<std::uint32_t>(cell.x - block * row_cells_);
    places_[k] = RowOf(block, cell.y, cell.z) * static_cast<std::uint32_t>(row_cells_) + in_row;
    ++begin_[places_[k] + 2];
  }
}

double GridLevel::Crowding() const {
  double squares = 0;
  for (const std::uint32_t count : begin_) squares += static_cast<double>(count) * count;
  return squares / size_;
}

// Agents keep their order within a cell. A position is stored as seen from the corner of its row,
// or block, and cell (kStoredPositionLoss).
void GridLevel::Scatter(const PlacedBall* placed) {
  for (std::size_t cell = 2; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  lanes_.Reset(size_);
  const auto lost =
      static_cast<float>(kStoredPositionLoss * cell_ * static_cast<double>(row_cells_ + 1));
  constexpr std::uint32_t kAhead = 16;
  // First the order, then the agents in it: a few random reads cost less than many random writes.
  order_.resize(size_);
  for (std::uint32_t k = 0; k < size_; ++k) {
    places_[k] = begin_[places_[k] + 1]++;
    order_[places_[k]] = k;
  }
  for (std::uint32_t place = 0; place < size_;) {
    const PlacedBall& first = placed[order_[place]];
    const Cell cell = CellOf(first.c[0], first.c[1], first.c[2]);
    const std::int64_t block = hashed_ ? cell.x & -row_cells_ : 0;
    const double corner[3] = {origin_[0] + static_cast<double>(block) * cell_,
                              origin_[1] + static_cast<double>(cell.y) * cell_,
                              origin_[2] + static_cast<double>(cell.z) * cell_};
    // All of a box's row has one corner; a row found by hashing may be shared by several.
    const auto row = static_cast<std::size_t>(RowOf(0, cell.y, cell.z) + 1);
    const std::uint32_t end =
        hashed_ ? place + 1 : begin_[row * static_cast<std::size_t>(row_cells_)];
    for (; place < end; ++place) {
      if (place + kAhead < size_) __builtin_prefetch(&placed[order_[place + kAhead]]);
      lanes_.Set(place, placed[order_[place]], corner, lost);
    }
  }
}

void GridLevel::Validate() const {
  CORE_CHECK(size_ == lanes_.size() && size_ == places_.size() && size_ == order_.size(),
             "a grid has a lane and a place for each of its agents", size_, lanes_.size());
  CORE_CHECK(cell_ >= cell_min_ && cell_min_ > 0, "a cell is as wide as two reaches", cell_,
             cell_min_);
  CORE_CHECK(begin_.front() == 0 && begin_[begin_.size() - 2] == size_,
             "cells hold all agents of the grid", begin_.front(), begin_[begin_.size() - 2], size_);
  CORE_CHECK(std::is_sorted(begin_.begin(), begin_.end() - 1), "cells do not overlap");
  for (std::uint32_t k = 0; k < size_; ++k) {
    CORE_CHECK(places_[k] < size_ && order_[places_[k]] == k,
               "places and order are each other's inverse", k, places_[k]);
  }
  lanes_.Validate(size_);
}

double GridLevel::RowsWithin(double reach, TimeWindow window) const {
  const double cells = 2 * (reach + ReachMax(window)) * per_cell_ + 1;
  double rows = hashed_ ? std::ceil(cells / static_cast<double>(row_cells_)) : 1;
  for (int axis = 1; axis < 3; ++axis) {
    rows *= hashed_ ? cells : std::min(cells, static_cast<double>(cells_[axis]));
  }
  return std::min(rows, static_cast<double>(size_));
}

bool GridLevel::Ranges(const double* c, double reach, TimeWindow window, std::uint32_t after,
                       std::vector<FilterRange>* ranges) const {
  const double half = kRangeSlack * (reach + ReachMax(window));
  const Cell low = CellOf(c[0] - half, c[1] - half, c[2] - half);
  const Cell high = CellOf(c[0] + half, c[1] + half, c[2] + half);
  const std::int64_t shift = hashed_ ? kHashedRowShift : 62;
  const double rows = static_cast<double>(high.y - low.y + 1) *
                      static_cast<double>(high.z - low.z + 1) *
                      static_cast<double>((high.x >> shift) - (low.x >> shift) + 1);
  if (hashed_ && rows > static_cast<double>(size_) + 8) return false;
  Cell own{};
  if (after != PlacedBalls::kNoAgent) own = CellOf(c[0], c[1], c[2]);
  for (std::int64_t z = after != PlacedBalls::kNoAgent ? own.z : low.z; z <= high.z; ++z) {
    const auto at_z = static_cast<float>(c[2] - (origin_[2] + static_cast<double>(z) * cell_));
    const bool own_z = after != PlacedBalls::kNoAgent && z == own.z;
    for (std::int64_t y = own_z ? own.y : low.y; y <= high.y; ++y) {
      const auto at_y = static_cast<float>(c[1] - (origin_[1] + static_cast<double>(y) * cell_));
      const std::uint32_t from = own_z && y == own.y ? after + 1 : 0;
      for (std::int64_t block = low.x >> shift; block <= high.x >> shift; ++block) {
        const std::int64_t first = hashed_ ? block * row_cells_ : 0;
        const std::size_t row =
            static_cast<std::size_t>(RowOf(block, y, z)) * static_cast<std::size_t>(row_cells_);
        const auto in_row_from = static_cast<std::size_t>(std::max(low.x - first, std::int64_t{0}));
        const auto in_row_to =
            static_cast<std::size_t>(std::min(high.x - first, row_cells_ - 1)) + 1;
        const std::uint32_t begin = std::max(begin_[row + in_row_from], from);
        const std::uint32_t end = begin_[row + in_row_to];
        if (begin >= end) continue;
        ranges->push_back(
            {begin, end,
             static_cast<float>(c[0] - (origin_[0] + static_cast<double>(first) * cell_)), at_y,
             at_z});
      }
    }
  }
  return true;
}

}  // namespace collision::broad_phase
