#include "collision_core/broad_phase/filter/point_grid.h"

#include <cmath>

#include "collision_core/broad_phase/filter/sphere_filter.h"
#include "collision_core/numeric/cube_root.h"

namespace collision::broad_phase {
namespace {

/// Points in a cell of an evenly filled grid, so that rows of three cells fill a wide vector.
constexpr double kPerCell = 5;

/// Longer rows would cost too many digits of a position.
constexpr double kRowCellsMax = 4096;

/// The most cells per point; beyond it most are empty.
constexpr double kCellsPerPoint = 4;

/// Lines are compared where the cube of a reach holds more points than this.
constexpr double kDense = 0.05;

/// Up to this number all points share one cell.
constexpr std::uint32_t kFewPoints = 32;

/// Squares beyond this length [m] might overflow in single precision.
constexpr double kLengthMax = 0x1p60;

/// Relative to a row's length: positions lose at most 2^-24 of it on each axis, for both points of
/// a pair, and reaches and the ranges' bounds as much. Squares lose digits to underflow below
/// kReachLeast.
constexpr double kRowLoss = 0x1p-20;

/// What cells have to hold beside the reach, as a share of it and of the box: four times kRowLoss,
/// and of the factors that raise reaches.
constexpr double kReachSlack = 0x1p-18;

/// Cells are wider than two reaches by far more than the quotients by them are rounded.
constexpr double kCellUp = 1 + 0x1p-10;

/// No less than what raises the reach of each entry, and one product.
constexpr float kReachMostUp = 1 + 0x1p-19f;

}  // namespace

bool PointGrid::ChooseCells(std::uint32_t present, const PointExtent& extent) {
  double widest = 0, volume = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(extent.low[axis] <= extent.high[axis])) return false;  // no point is there
    origin_[axis] = extent.low[axis];
    widest = std::max(widest, extent.high[axis] - extent.low[axis]);
  }
  if (!(widest < kLengthMax) || !(static_cast<double>(extent.reach) < kLengthMax)) return false;
  constexpr double kLeast = kReachLeast;
  const double reach =
      static_cast<double>(extent.reach) * (1 + kReachSlack) + kReachSlack * widest + 2 * kLeast;
  for (int axis = 0; axis < 3; ++axis) {
    volume *= std::max(extent.high[axis] - extent.low[axis], 2 * reach);
  }
  cell_ = std::max(2 * reach * kCellUp, numeric::CubeRoot(volume * kPerCell / present));
  if (present <= kFewPoints) cell_ = 2 * (widest + reach);
  per_cell_ = 1 / cell_;
  double total = 1, cells[3];
  for (int axis = 0; axis < 3; ++axis) {
    cells[axis] = std::floor((extent.high[axis] - extent.low[axis]) * per_cell_) + 1;
    total *= cells[axis];
  }
  if (!(total <= kCellsPerPoint * present + 64) || cells[0] > kRowCellsMax) return false;
  if (total < 2 && present > kFewPoints) return false;
  for (int axis = 0; axis < 3; ++axis) cells_[axis] = static_cast<std::int32_t>(cells[axis]);
  lost_ = static_cast<float>(kRowLoss * cell_ * cells_[0]) + kReachLeast;
  reach_most_ = extent.reach * kReachMostUp + lost_;
  begin_.assign(static_cast<std::size_t>(total) + 3, 0);
  return true;
}

bool PointGrid::IsDense(std::uint32_t present, const PointExtent& extent) const {
  const auto reach = static_cast<double>(extent.reach);
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis) volume *= extent.high[axis] - extent.low[axis] + reach;
  return reach * reach * reach * present > kDense * volume;
}

bool PointGrid::SumCells(std::uint32_t present) {
  double squares = 0;
  std::uint32_t sum = 0;
  for (std::size_t cell = 2; cell + 1 < begin_.size(); ++cell) {
    const std::uint32_t in_cell = begin_[cell];
    squares += static_cast<double>(in_cell) * in_cell;
    sum += in_cell;
    begin_[cell] = sum;
  }
  return present <= kFewPoints || squares <= kCrowdingMax * present;
}

// Long arrays are not a whole number of pages apart: else they would compete for the same lines of
// the processor's cache.
void PointGrid::Reserve(std::uint32_t count) {
  constexpr std::size_t kPage = 1024, kApart = 208;
  std::size_t room = count + kLanesMax;
  if (room > kPage) room = (room + kPage - 1) / kPage * kPage + kApart;
  const std::size_t arrays = half_ > 0 ? 8 : 4;
  if (room > stride_ || floats_.size() < arrays * stride_) {
    stride_ = std::max(room, stride_);
    floats_.assign(arrays * stride_, 0);
  }
  if (half_ > 0) motions_.resize(count);
  order_.resize(count);
  entries_.resize(count);
  cell_of_.resize(count);
}

std::uint32_t PointGrid::RowsBeside(std::int32_t x, std::int32_t y, std::int32_t z,
                                    std::size_t cell) {
  const std::uint32_t before = x > 0, after = x + 1 < cells_[0];
  const std::int32_t y_from = y > 0 ? -1 : 0, y_to = y + 1 < cells_[1];
  const std::int32_t z_to = z + 1 < cells_[2];
  std::uint32_t count = 0;
  std::size_t points = 0;
  for (std::int32_t dz = 0; dz <= z_to; ++dz) {
    for (std::int32_t dy = dz == 0 ? 0 : y_from; dy <= y_to; ++dy) {
      const std::size_t beside = cell + static_cast<std::size_t>((dz * cells_[1] + dy) * cells_[0]);
      const bool own = dz == 0 && dy == 0;
      const std::uint32_t begin = begin_[own ? beside : beside - before];
      const std::uint32_t end = begin_[beside + after + 1];
      if (begin == end) continue;
      rows_[count++] = {begin, end, dy, dz};
      points += end - begin;
    }
  }
  const std::size_t room = kBatch + kQueryPointsMax * points + kLanesMax;
  if (queries_.size() < room) {
    queries_.resize(room);
    others_.resize(room);
  }
  return count;
}

}  // namespace collision::broad_phase
