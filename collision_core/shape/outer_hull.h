// A convex body around a shape, with a fast bound of its reach along a direction.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "collision_core/base/check.h"

namespace collision::shape {

/// The points for one cell of directions. Along a direction of the cell whose greatest coordinate
/// is 1, the whole body reaches farther than the best of these points by at most `more` [m]. In
/// single precision, seen from the hull's origin; unused places repeat the first point. One cache
/// line.
struct alignas(64) HullCell {
  static constexpr std::uint32_t kPoints = 4;
  float x[kPoints], y[kPoints], z[kPoints];
  float more;
};

/// A convex body that contains a shape and is little more than its convex hull; at most 24 kB,
/// however many triangles there are. Stored in single precision. It bounds how far the shape
/// reaches along a direction.
///
/// Directions are sorted into the cells of a cube, as in convex_points.h, but a cell keeps four
/// points at most: one line of a cache. On a face of the cube, along (1, u, v), the difference of
/// two points is linear in u and v and greatest at a corner of the cell, so the amount by which a
/// point that was left out may exceed those that were kept is known (`HullCell::more`). The body's
/// reach equals that of the convex hull along half of the directions for homer and spot; for
/// rocker-arm its excess is at most 0.1 % of the diameter along half of them; the largest excess is
/// 2 %. Construction takes about a microsecond a vertex.
class OuterHull {
 public:
  /// The hull of nothing.
  OuterHull() = default;
  /// The hull of everything within `rounding` [m] of the points' convex hull. Requires a point;
  /// finite coordinates below 1e15 m, whose squares single precision holds.
  OuterHull(std::span<const Eigen::Vector3d> points, double rounding);

  /// How far the hull reaches along a direction, and where.
  struct Support {
    float height;           ///< n·x <= height + kHullSupportError extent() for all x of the shape.
    Eigen::Vector3f point;  ///< The point there, approximately.
  };
  /// The support along n, relative to origin(). Requires |n| within 2^-16 of 1. Unchecked: the
  /// hull is not empty.
  Support Along(const Eigen::Vector3f& n) const;

  /// The support along n of any length, so that the caller may compute the length at the same time:
  /// n·x <= height + more |n|, but for kHullSupportError as above.
  struct Foremost {
    float height, more;
    Eigen::Vector3f point;
  };
  Foremost ForemostAlong(const Eigen::Vector3f& n) const;

  const Eigen::Vector3d& origin() const { return origin_; }  ///< In the body frame.
  double extent() const {
    return extent_;
  }  ///< No point of the shape is farther from origin() [m].
  /// The squares of the box's half edges over the square of extent(), plus 2^-10: the proportions
  /// of the shape.
  const Eigen::Vector3f& measure() const { return measure_; }
  std::size_t bytes() const { return cells_.capacity() * sizeof(HullCell); }

 private:
  struct Patch;

  std::uint32_t CellOf(const Eigen::Vector3f& n) const;
  void Divide(const Patch& patch, const std::vector<Eigen::Vector3d>& points);

  std::uint32_t along_edge_ = 0;  ///< Cells along an edge of the cube.
  std::vector<HullCell> cells_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double extent_ = 0;
  float rounding_ = 0;
  Eigen::Vector3f measure_ = Eigen::Vector3f::Zero();
};

/// Error of a support as a share of the extent E. With u = 2^-24: three products and two sums are
/// off by 3.1 u E, the sums with `more` and the rounding by 2.1 u E; a direction that rounding
/// sorts into the next cell is off by 3 u in each of two coordinates of (1, u, v), there and back 9
/// u E: in all less than 15 u E.
inline constexpr double kHullSupportError = 15 * 0x1p-24;

/// Relative to the square of a direction's length, which a cast leaves off by a few units of 2^-24:
/// what is off by more is no unit vector.
inline constexpr float kUnitSquareError = 0x1p-14f;

/// The cell of a direction, as in ConvexPoints::CellOf().
inline std::uint32_t OuterHull::CellOf(const Eigen::Vector3f& n) const {
  const float x = std::abs(n.x()), y = std::abs(n.y()), z = std::abs(n.z());
  const int axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
  const int second = axis == 2 ? 0 : axis + 1, third = 3 - axis - second;
  const float half = 0.5f * static_cast<float>(along_edge_), scale = half / std::abs(n[axis]);
  const auto last = static_cast<std::int32_t>(along_edge_) - 1;
  const auto cell = [&](int i) {
    const auto at = static_cast<std::int32_t>(n[i] * scale + half);
    return static_cast<std::uint32_t>(std::clamp(at, 0, last));
  };
  const std::uint32_t face = 2 * static_cast<std::uint32_t>(axis) + (n[axis] < 0 ? 1 : 0);
  return (face * along_edge_ + cell(second)) * along_edge_ + cell(third);
}

inline OuterHull::Foremost OuterHull::ForemostAlong(const Eigen::Vector3f& n) const {
  const HullCell& cell = cells_[CellOf(n)];
  float heights[HullCell::kPoints];
  for (std::uint32_t i = 0; i < HullCell::kPoints; ++i) {
    heights[i] = (n.x() * cell.x[i] + n.y() * cell.y[i]) + n.z() * cell.z[i];
  }
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < HullCell::kPoints; ++i) {
    best = heights[i] > heights[best] ? i : best;
  }
  // Not heights[best], which would have to wait for `best`.
  const float height = std::max(std::max(heights[0], heights[1]), std::max(heights[2], heights[3]));
  return {height, cell.more + rounding_, {cell.x[best], cell.y[best], cell.z[best]}};
}

inline OuterHull::Support OuterHull::Along(const Eigen::Vector3f& n) const {
  CORE_CHECK(std::abs(n.squaredNorm() - 1) < kUnitSquareError, "the direction has length 1",
             n.norm());
  const Foremost foremost = ForemostAlong(n);
  return {foremost.height + foremost.more, foremost.point};
}

}  // namespace collision::shape
