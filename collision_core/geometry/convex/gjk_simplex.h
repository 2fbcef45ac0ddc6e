// The point of a simplex nearest to the origin.
#pragma once

#include <Eigen/Core>
#include <array>

namespace collision::geometry {

/// What is nearest, and of which corners.
struct SimplexPoint {
  std::array<int, 4> corners;     ///< That span the face the nearest point lies on; ascending.
  std::array<double, 4> weights;  ///< Of `count` corners: >= 0; their sum is 1 to within rounding.
  int count;
  Eigen::Vector3d nearest;
  double square;  ///< |nearest|²
  bool encloses;  ///< The origin seems to be inside of a tetrahedron.
};

/// `newest`: faces without that corner need not be looked at; −1: all are. Plain doubles: slivers
/// may be judged wrongly, with a `nearest` that is the weighted sum, or its part along the face's
/// normal, all the same.
void NearestOfSimplex(const std::array<const Eigen::Vector3d*, 4>& corners, int count, int newest,
                      SimplexPoint* point);

}  // namespace collision::geometry
