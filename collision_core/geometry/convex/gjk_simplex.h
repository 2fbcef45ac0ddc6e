// The point of a simplex nearest to the origin.
#pragma once

#include <Eigen/Core>
#include <array>

namespace collision::geometry {

/// The point of a simplex nearest to the origin, as a weighted sum of some of its corners.
struct SimplexPoint {
  std::array<int, 4> corners;  ///< The `count` corners of the face that holds the point, ascending.
  std::array<double, 4> weights;  ///< Their weights: >= 0, with sum 1 to within rounding.
  int count;
  Eigen::Vector3d nearest;
  double square;  ///< |nearest|²
  bool encloses;  ///< The origin seems to be inside the tetrahedron.
};

/// Finds the point nearest to the origin of the simplex of the first `count` (1 to 4) corners.
/// `newest`: the corner added last, so that faces of a tetrahedron without it are skipped; −1: no
/// face is skipped. Computed in plain doubles: for slivers the face may be the wrong one, but
/// `nearest` is still the weighted sum of its corners, or the part of that sum along the face's
/// normal.
void NearestOfSimplex(const std::array<const Eigen::Vector3d*, 4>& corners, int count, int newest,
                      SimplexPoint* point);

}  // namespace collision::geometry
