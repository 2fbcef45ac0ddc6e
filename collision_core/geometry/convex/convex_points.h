// The support function of a set of points: which of them lies furthest along a direction.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace collision::geometry {

/// Points as the vertices of a hull that is never built. Any points are accepted (duplicates, flat,
/// collinear, inner ones); inner points cost little and are never the answer.
///
/// Directions are sorted into the cells of a cube around the origin, and for each cell those points
/// are kept that may be furthest along one of its directions. Along the directions (1, u, v) of a
/// cell on a face of the cube, the difference of two points is linear in u and v: a point that
/// another one exceeds at all four corners of a cell is never needed there. So a query costs a
/// handful of products however many points there are, and its error is bounded.
class ConvexPoints {
 public:
  ConvexPoints() = default;
  /// Requires finite coordinates below 1e100.
  explicit ConvexPoints(std::span<const Eigen::Vector3d> points);

  std::size_t size() const { return points_.size(); }
  const Eigen::Vector3d& operator[](std::uint32_t index) const { return points_[index]; }
  /// The largest distance of a point from the origin, rounded up.
  double reach() const { return reach_; }

  /// The index of a point x whose n·x, computed in doubles, is greatest. Its exact n·x is within 16
  /// · 2^-53 |n| reach() of the greatest one. Unchecked: there is a point.
  std::uint32_t Furthest(const Eigen::Vector3d& n) const {
    return cells_ == 0 ? FurthestOf(n, 0, all_) : FurthestInCell(n, CellOf(n));
  }

  /// A copy of the points for wide vectors: for every four points their x, then their y, then their
  /// z; the last point fills up the last block. Empty if there are more than kBlockPointsMax
  /// points.
  const std::vector<double>& blocks() const { return blocks_; }
  static constexpr std::size_t kBlockPointsMax = 64;
  /// The greatest magnitude of each coordinate over all points.
  const Eigen::Vector3d& extents() const { return extents_; }

  std::size_t bytes() const {
    return points_.size() * sizeof(Eigen::Vector3d) + blocks_.size() * sizeof(double) +
           (starts_.size() + kept_.size()) * sizeof(std::uint32_t);
  }

 private:
  /// A square of cells on a face of the cube, in units of the finest ones.
  struct Patch {
    std::uint32_t face, u, v, width;
  };

  std::uint32_t FurthestOf(const Eigen::Vector3d& n, std::uint32_t first, std::uint32_t end) const {
    std::uint32_t best = first;
    double most = n.dot(points_[first]);
    for (std::uint32_t i = first + 1; i < end; ++i) {
      const double along = n.dot(points_[i]);
      if (along > most) most = along, best = i;
    }
    return best;
  }

  std::uint32_t FurthestInCell(const Eigen::Vector3d& n, std::uint32_t cell) const {
    const std::uint32_t first = starts_[cell], end = starts_[cell + 1];
    std::uint32_t best = kept_[first];
    double most = n.dot(points_[best]);
    for (std::uint32_t i = first + 1; i < end; ++i) {
      const double along = n.dot(points_[kept_[i]]);
      if (along > most) most = along, best = kept_[i];
    }
    return best;
  }

  /// The cell of a direction: on the face of the cube that its coordinate of greatest magnitude
  /// selects.
  std::uint32_t CellOf(const Eigen::Vector3d& n) const {
    const double x = std::abs(n.x()), y = std::abs(n.y()), z = std::abs(n.z());
    const int axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    const double along = n[axis];
    if (along == 0) return 0;
    const double scale = 0.5 * cells_ / std::abs(along), half = 0.5 * cells_;
    const auto cell = [&](int k) {
      const auto i = static_cast<std::int32_t>(n[(axis + k) % 3] * scale + half);
      return static_cast<std::uint32_t>(std::clamp(i, 0, static_cast<std::int32_t>(cells_) - 1));
    };
    const std::uint32_t face = 2 * axis + (along < 0 ? 1 : 0);
    return (face * cells_ + cell(1)) * cells_ + cell(2);
  }

  void SetBlocks();
  Eigen::Vector3d CornerOf(const Patch& patch, std::uint32_t u, std::uint32_t v) const;
  void Divide(const Patch& patch, std::vector<std::uint32_t> candidates);
  std::vector<std::uint32_t> Needed(const Patch& patch, double margin,
                                    const std::vector<std::uint32_t>& candidates) const;

  std::vector<Eigen::Vector3d> points_;
  std::uint32_t all_ = 0;
  /// Cells along an edge of the cube; 0: no cells, each query tests all points.
  std::uint32_t cells_ = 0;
  std::vector<std::uint32_t> starts_, kept_;
  /// The points kept for each cell; used during construction only.
  std::vector<std::vector<std::uint32_t>> of_cell_;
  double reach_ = 0;
  std::vector<double> blocks_;
  Eigen::Vector3d extents_{0, 0, 0};
};

}  // namespace collision::geometry
