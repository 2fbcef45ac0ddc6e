// Triangles in pieces that unite to them exactly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"

namespace collision::sphere_tree {

/// What one halving adds to the error of a stored corner, in units of 2^−53 times the largest
/// coordinate S of the mesh.
///
/// A piece is halved from a corner to the middle of the opposite edge ab, which *is* (a + b) / 2
/// exactly, so that both halves unite to the whole. The stored value is fl(0.5 fl(a_x + b_x)): the
/// sum is off by u · 2 S, u = 2^−53, its half by u S (it underflows by 2^−1075 at most, nothing
/// compared with the rest); over three coordinates √3 u S < 1.8 u S. Where a and b are off by e at
/// most themselves, so is their middle. After n halvings one upon the other, 2 n u S.
inline constexpr double kHalvingError = 2;

/// The most successive halvings: after that an edge is shorter than its rounding.
inline constexpr std::uint8_t kHalvingsMax = 60;

/// Its corners are indices for FittedPieces::PointAt().
struct FittedPiece {
  std::array<std::uint32_t, 3> corners;
  ElementIndex triangle;
};

/// All pieces: at first the whole triangles.
class FittedPieces {
 public:
  explicit FittedPieces(const geometry::TriangleMesh& mesh);

  const FittedPiece& operator[](std::uint32_t i) const { return list_[i]; }
  std::size_t size() const { return list_.size(); }
  const Eigen::Vector3d& PointAt(std::uint32_t i) const { return points_[i]; }
  std::size_t points() const { return points_.size(); }

  /// How far a stored corner may be off, rounded up.
  double ErrorAt(std::uint32_t point) const;

  /// The square of the longest edge; 0 if it may not be halved once more.
  double LongestEdge2(std::uint32_t piece) const;

  /// Halves a piece across its longest edge (of equal ones the first); it becomes the first half.
  /// Returns the second, the last of all.
  std::uint32_t Halve(std::uint32_t piece);

 private:
  int LongestEdge(const FittedPiece& piece) const;

  std::vector<FittedPiece> list_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint8_t> halvings_;
  double coordinate_max_ = 0;
};

}  // namespace collision::sphere_tree
