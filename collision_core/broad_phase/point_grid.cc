#include "collision_core/broad_phase/point_grid.h"

#include "collision_core/numeric/cube_root.h"

namespace collision {
namespace {

/// Points in a cell of an evenly filled grid: rows of three cells fill a wide vector.
constexpr double kPerCell = 4;

/// Longer rows would cost too many digits of a position.
constexpr double kRowCellsMax = 4096;

/// Cells per point, beyond which most are empty.
constexpr double kCellsPerPoint = 4;

/// So many points are seen in the own cell at most, on the average, in a grid of use.
constexpr double kCrowdingMax = 4 * kPerCell;

/// Few points are in one cell, whatever they are like.
constexpr std::uint32_t kFewPoints = 128;

}  // namespace

// Positions lose at most 2^-24 of a row's length on each axis, the asker's as well, and reaches and
// the ranges' bounds as much: together less than 2^-20 of it. Squares lose digits to underflow below
// kReachLeast.
bool PointGrid::ChooseCells(std::uint32_t count, const PointExtent& extent) {
  double widest = 0, volume = 1;
  for (int axis = 0; axis < 3; ++axis) {
    origin_[axis] = extent.low[axis];
    widest = std::max(widest, extent.high[axis] - extent.low[axis]);
  }
  if (!(widest < 0x1p60) || !(extent.reach < 0x1p60f)) return false;
  constexpr double kLeast = kReachLeast;
  const double reach =
      static_cast<double>(extent.reach) * (1 + 0x1p-18) + 0x1p-18 * widest + 2 * kLeast;
  for (int axis = 0; axis < 3; ++axis) {
    volume *= std::max(extent.high[axis] - extent.low[axis], 2 * reach);
  }
  cell_ = std::max(2 * reach * (1 + 0x1p-10), CubeRoot(volume * kPerCell / count));
  if (count <= kFewPoints) cell_ = 2 * (widest + reach);
  per_cell_ = 1 / cell_;
  double total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cell_last_[axis] = std::floor((extent.high[axis] - extent.low[axis]) * per_cell_);
    total *= cell_last_[axis] + 1;
  }
  if (total > kCellsPerPoint * count + 64 || cell_last_[0] >= kRowCellsMax) return false;
  if (total < 2 && count > kFewPoints) return false;
  for (int axis = 0; axis < 3; ++axis)
    cells_[axis] = static_cast<std::int32_t>(cell_last_[axis]) + 1;
  lost_ = static_cast<float>(0x1p-20 * cell_ * cells_[0]) + kReachLeast;
  reach_most_ = extent.reach * (1 + 0x1p-19f) + lost_;
  begin_.assign(static_cast<std::size_t>(total) + 2, 0);
  return true;
}

bool PointGrid::SumCells(std::uint32_t count) {
  double squares = 0;
  std::uint32_t sum = 0;
  for (std::size_t cell = 2; cell < begin_.size(); ++cell) {
    const std::uint32_t in_cell = begin_[cell];
    squares += static_cast<double>(in_cell) * in_cell;
    sum += in_cell;
    begin_[cell] = sum;
  }
  return count <= kFewPoints || squares <= kCrowdingMax * count;
}

// The four arrays, where they are long, are not a whole number of pages apart, else they would fight
// for the same lines of the processor's cache.
void PointGrid::Reserve(std::uint32_t count) {
  constexpr std::size_t kPage = 1024, kApart = 208;
  std::size_t room = count + kLanesMax;
  if (room > kPage) room = (room + kPage - 1) / kPage * kPage + kApart;
  if (room > stride_) {
    stride_ = room;
    floats_.assign(4 * stride_, 0);
  }
  order_.resize(count);
  entries_.resize(count);
  cell_of_.resize(count);
  if (hits_.size() < count + kLanesMax) hits_.resize(count + kLanesMax);
}

}  // namespace collision
