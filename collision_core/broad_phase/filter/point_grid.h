// Which points of many lie within reach of each other: one pass over a grid. Callers: the one-shot
// queries Earliest() and FindNearPairs() of the spatial index (sweeping_index.h), so not the
// service.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/filter/point_filter.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::broad_phase {

/// A moving ball for one window of time, seen from half-way through it. PlacedBall's reach grows
/// with time; here it is taken at the window's end, once for a centre that stays and once for one
/// that moves along its line. Both are rounded up, with SphereFilter's slack. Made by
/// PlacementFrame::HalfWay(), whose rounding argument is that of PlacedBall.
struct ReachPoint {
  double c[3];  ///< Its centre half-way through the window.
  float v[3];   ///< As seen from the placement's frame.
  float reach;  ///< During the window the ball lies within this of c [m].
  float own;    ///< At u seconds after half-way it lies within this of c + v u [m].
};

/// The box around points, and the farthest reach.
struct PointExtent {
  double low[3] = {numeric::kInfinity, numeric::kInfinity, numeric::kInfinity},
         high[3] = {-numeric::kInfinity, -numeric::kInfinity, -numeric::kInfinity};
  float reach = 0;

  void Add(const ReachPoint& point) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point.c[axis]);
      high[axis] = std::max(high[axis], point.c[axis]);
    }
    reach = std::max(reach, point.reach);
  }
  void Widen(double part) {
    for (int axis = 0; axis < 3; ++axis) {
      const double more = part * (high[axis] - low[axis]);
      low[axis] -= more, high[axis] += more;
    }
    reach *= static_cast<float>(1 + part);
  }

  bool Holds(const ReachPoint& point) const {
    bool within = point.reach <= reach;
    for (int axis = 0; axis < 3; ++axis) {
      within = within && point.c[axis] >= low[axis] && point.c[axis] <= high[axis];
    }
    return within;
  }
};

/// A grid for one query about all agents at once, where they have similar reaches and are evenly
/// spread. Half-way through the window each agent is a point with a reach: sixteen bytes in the
/// order of the cells, thirty-two where lines are compared. Nothing is kept for a later query.
///
/// A sample of the points determines how wide the grid is, and whether it suits the scene; if a
/// point lies beyond the sampled extent the grid is built again. PointFilter takes up to eight
/// points of a cell at a time and compares each with sixteen others in the rows beside it; where
/// reaches are so long that many places are near each other, it compares their lines in the same
/// step. Cells that lie side by side along x do so in memory as well, and are scanned as one range.
class PointGrid {
 public:
  /// Builds the grid of up to `count` points. `at(k, &point)` writes the k-th one, or returns false
  /// if there is none; about `present` exist. It is called once for every point and up to twice
  /// more for those of a sample; all are read again if some lie well beyond the sample. `half`:
  /// half of the window [s], to compare lines as well where many places come near each other; 0:
  /// never compare lines. Returns false if the points do not suit a grid: they crowd in few of its
  /// cells, or its rows would be too long.
  template <typename At>
  bool Build(std::uint32_t count, std::uint32_t present, double half, At at);

  /// Calls visit(k, l) once for each pair of points that may be within the sum of their reaches,
  /// and some pairs earlier fetch(k, l), so that it can prefetch what visit() reads.
  template <typename Fetch, typename Visit>
  void ForEachPair(Fetch fetch, Visit visit);
  template <typename Visit>
  void ForEachPair(Visit visit) {
    ForEachPair([](std::uint32_t, std::uint32_t) {}, visit);
  }

  /// Comparisons of two points, and ranges scanned, since the start.
  std::uint64_t tests() const { return tests_; }
  std::uint64_t ranges() const { return range_count_; }

 private:
  /// A cell's own row, and the rows beside it that come later.
  static constexpr int kRowsMax = 5;
  /// The most points that are sampled for the extent (at least half as many are, if they exist),
  /// and the part by which the extent is then widened for the points that are not.
  static constexpr std::uint32_t kSample = 4096;
  static constexpr double kBeyondSample = 1.0 / 32;
  /// The most points that a point may find in its own cell, on the average, for a grid to be used.
  static constexpr double kCrowdingMax = 16;
  /// Pairs visited at a time, enough for what was fetched for them to have arrived.
  static constexpr std::uint32_t kBatch = 64;

  struct Entry {
    float x, y, z, reach;
  };
  struct Motion {
    float vx, vy, vz, own;
  };

  /// The extent of every stride-th point.
  template <typename At>
  static PointExtent Measure(std::uint32_t count, std::uint32_t stride, At at);
  bool IsDense(std::uint32_t present, const PointExtent& extent) const;
  /// Whether the sample, every stride-th point, shares so many cells that all points must be
  /// crowded.
  template <typename At>
  bool LooksCrowded(std::uint32_t count, std::uint32_t present, std::uint32_t stride,
                    const PointExtent& extent, At at);
  /// False: one lies beyond the extent.
  template <typename At>
  bool Fill(std::uint32_t count, const PointExtent& extent, At at);
  bool ChooseCells(std::uint32_t present, const PointExtent& extent);
  /// Turns counts of the cells into their begins; false: they are crowded.
  bool SumCells(std::uint32_t present);
  void Reserve(std::uint32_t count);
  float* Array(int k) { return floats_.data() + static_cast<std::size_t>(k) * stride_; }
  /// Writes the rows that a cell is compared with into rows_, and returns their number: a cell is
  /// at least two reaches wide, so that what is near lies in neighbouring cells. Makes room for as
  /// many hits as they can have.
  std::uint32_t RowsBeside(std::int32_t x, std::int32_t y, std::int32_t z, std::size_t cell);
  std::int32_t CellOf(double x, int axis) const {
    // Within the extent no point lies past the last cell, which is computed the same way.
    return static_cast<std::int32_t>((x - origin_[axis]) * per_cell_);
  }
  std::uint32_t CellAt(const ReachPoint& point) const {
    const std::int32_t row = CellOf(point.c[2], 2) * cells_[1] + CellOf(point.c[1], 1);
    return static_cast<std::uint32_t>(row * cells_[0] + CellOf(point.c[0], 0));
  }

  double origin_[3] = {};
  double cell_ = 0, per_cell_ = 0;
  float reach_most_ = 0, lost_ = 0, half_ = 0;
  std::int32_t cells_[3] = {};
  /// By cell; then one cell for points that do not exist, and two entries more.
  std::vector<std::uint32_t> begin_;
  std::vector<Entry> entries_;          ///< By point.
  std::vector<Motion> motions_;         ///< By point, where lines are compared.
  std::vector<std::uint32_t> cell_of_;  ///< By point.
  std::vector<std::uint32_t> order_;    ///< By place: its point.
  std::vector<float> floats_;           ///< Arrays by place: of entries, then of motions.
  std::size_t stride_ = 0;
  PointRow rows_[kRowsMax] = {};
  std::vector<std::uint32_t> queries_, others_;  ///< By hit.
  std::uint64_t tests_ = 0, range_count_ = 0;
};

template <typename At>
PointExtent PointGrid::Measure(std::uint32_t count, std::uint32_t stride, At at) {
  PointExtent extent;
  ReachPoint point;
  for (std::uint32_t k = 0; k < count; k += stride) {
    if (at(k, &point)) extent.Add(point);
  }
  return extent;
}

template <typename At>
bool PointGrid::LooksCrowded(std::uint32_t count, std::uint32_t present, std::uint32_t stride,
                             const PointExtent& extent, At at) {
  ReachPoint point;
  std::uint64_t pairs = 0;  // of points in the same cell
  for (std::uint32_t k = 0; k < count; k += stride) {
    if (at(k, &point) && extent.Holds(point)) pairs += begin_[CellAt(point)]++;
  }
  std::fill(begin_.begin(), begin_.end(), 0);
  return 2.0 * stride * stride * static_cast<double>(pairs) > kCrowdingMax * present;
}

template <typename At>
bool PointGrid::Fill(std::uint32_t count, const PointExtent& extent, At at) {
  const std::size_t none = begin_.size() - 3;
  ReachPoint point{};
  for (std::uint32_t k = 0; k < count; ++k) {
    if (!at(k, &point)) {
      cell_of_[k] = static_cast<std::uint32_t>(none);
      continue;
    }
    if (!extent.Holds(point)) return false;
    const std::int32_t y = CellOf(point.c[1], 1), z = CellOf(point.c[2], 2);
    // Seen from the corner of the row.
    entries_[k] = {static_cast<float>(point.c[0] - origin_[0]),
                   static_cast<float>(point.c[1] - (origin_[1] + y * cell_)),
                   static_cast<float>(point.c[2] - (origin_[2] + z * cell_)),
                   point.reach * numeric::kSomeFloatRoundingsUp + lost_};
    if (half_ > 0) {
      motions_[k] = {point.v[0], point.v[1], point.v[2],
                     point.own * numeric::kSomeFloatRoundingsUp + lost_};
    }
    cell_of_[k] = CellAt(point);
    ++begin_[cell_of_[k] + 2];
  }
  return true;
}

template <typename At>
bool PointGrid::Build(std::uint32_t count, std::uint32_t present, double half, At at) {
  std::uint32_t stride = count / kSample + 1;
  PointExtent extent = Measure(count, stride, at);
  if (stride > 1 && extent.reach == 0) stride = 1, extent = Measure(count, 1, at);
  if (stride > 1) extent.Widen(kBeyondSample);
  half_ = IsDense(present, extent) ? static_cast<float>(half) * numeric::kCastRoundingUp : 0;
  Reserve(count);
  if (!ChooseCells(present, extent)) return false;
  if (stride > 1 && LooksCrowded(count, present, stride, extent, at)) return false;
  if (!Fill(count, extent, at)) {
    extent = Measure(count, 1, at);
    if (!ChooseCells(present, extent) || !Fill(count, extent, at)) return false;
  }
  if (!SumCells(present)) return false;
  for (std::uint32_t k = 0; k < count; ++k) order_[begin_[cell_of_[k] + 1]++] = k;
  float *const x = Array(0), *const y = Array(1), *const z = Array(2), *const reach = Array(3);
  for (std::uint32_t place = 0; place < count; ++place) {
    const Entry& entry = entries_[order_[place]];
    x[place] = entry.x, y[place] = entry.y, z[place] = entry.z, reach[place] = entry.reach;
  }
  if (half_ == 0) return true;
  float *const vx = Array(4), *const vy = Array(5), *const vz = Array(6), *const own = Array(7);
  for (std::uint32_t place = 0; place < count; ++place) {
    const Motion& motion = motions_[order_[place]];
    vx[place] = motion.vx, vy[place] = motion.vy, vz[place] = motion.vz, own[place] = motion.own;
  }
  return true;
}

template <typename Fetch, typename Visit>
void PointGrid::ForEachPair(Fetch fetch, Visit visit) {
  const PointFilter scan = WidestPointFilter();
  PointView view{Array(0), Array(1), Array(2), Array(3)};
  if (half_ > 0) view.vx = Array(4), view.vy = Array(5), view.vz = Array(6), view.own = Array(7);
  std::uint32_t count = 0;
  const auto visit_all = [&] {
    for (std::uint32_t hit = 0; hit < count; ++hit) visit(queries_[hit], others_[hit]);
    count = 0;
  };
  std::size_t cell = 0;
  for (std::int32_t z = 0; z < cells_[2]; ++z) {
    for (std::int32_t y = 0; y < cells_[1]; ++y) {
      for (std::int32_t x = 0; x < cells_[0]; ++x, ++cell) {
        if (begin_[cell] == begin_[cell + 1]) continue;
        const std::uint32_t row_count = RowsBeside(x, y, z, cell);
        QueryPoints queries{begin_[cell], 0, static_cast<float>(cell_), reach_most_, half_};
        for (; queries.first < begin_[cell + 1]; queries.first = queries.last) {
          queries.last = std::min(queries.first + kQueryPointsMax, begin_[cell + 1]);
          const PointCounts counts = scan(view, queries, rows_, row_count,
                                          {queries_.data() + count, others_.data() + count});
          tests_ += counts.tests, range_count_ += counts.ranges;
          for (const std::uint32_t end = count + counts.hits; count < end; ++count) {
            queries_[count] = order_[queries_[count]], others_[count] = order_[others_[count]];
            fetch(queries_[count], others_[count]);
          }
          if (count >= kBatch) visit_all();
        }
      }
    }
  }
  visit_all();
}

}  // namespace collision::broad_phase
