#include "collision_core/sphere_tree/fitted/fitted_pieces.h"

#include <algorithm>

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::sphere_tree {

FittedPieces::FittedPieces(const geometry::TriangleMesh& mesh)
    : points_(mesh.vertices), halvings_(mesh.vertices.size(), 0) {
  list_.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    list_.push_back({mesh.triangles[i], ElementIndex(i)});
    for (const std::uint32_t corner : mesh.triangles[i])
      coordinate_max_ = std::max(coordinate_max_, points_[corner].cwiseAbs().maxCoeff());
  }
}

double FittedPieces::ErrorAt(std::uint32_t point) const {
  // The product of two small whole numbers and a power of two is exact, the last one rounds.
  return halvings_[point] == 0
             ? 0
             : numeric::MultiplyUp(kHalvingError * halvings_[point] * numeric::kUnitRoundoff,
                                   coordinate_max_);
}

int FittedPieces::LongestEdge(const FittedPiece& piece) const {
  int longest = 0;
  double most = -1;
  for (int i = 0; i < 3; ++i) {
    const double length2 =
        (points_[piece.corners[(i + 1) % 3]] - points_[piece.corners[i]]).squaredNorm();
    if (length2 > most) most = length2, longest = i;
  }
  return longest;
}

double FittedPieces::LongestEdge2(std::uint32_t piece) const {
  const FittedPiece& p = list_[piece];
  const int i = LongestEdge(p);
  const std::uint32_t a = p.corners[i], b = p.corners[(i + 1) % 3];
  if (std::max(halvings_[a], halvings_[b]) >= kHalvingsMax) return 0;
  return (points_[b] - points_[a]).squaredNorm();
}

std::uint32_t FittedPieces::Halve(std::uint32_t piece) {
  FittedPiece& first = list_[piece];
  const int i = LongestEdge(first), j = (i + 1) % 3;
  const std::uint32_t a = first.corners[i], b = first.corners[j];
  const auto middle = static_cast<std::uint32_t>(points_.size());
  const Eigen::Vector3d point = 0.5 * (points_[a] + points_[b]);
  points_.push_back(point);
  halvings_.push_back(static_cast<std::uint8_t>(1 + std::max(halvings_[a], halvings_[b])));
  FittedPiece second = first;
  first.corners[j] = middle;
  second.corners[i] = middle;
  list_.push_back(second);
  return static_cast<std::uint32_t>(list_.size() - 1);
}

}  // namespace collision::sphere_tree
