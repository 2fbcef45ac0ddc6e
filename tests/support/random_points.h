// Seeded points and triangles for tests of geometry.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tests/support/random.h"

namespace collision {

/// In the cube [-half, half]³, uniformly.
inline Eigen::Vector3d InCube(Random& random, double half) {
  const double x = random.Uniform(-half, half), y = random.Uniform(-half, half),
               z = random.Uniform(-half, half);
  return {x, y, z};
}

/// Corners at the distance `size` from the centre.
inline std::array<Eigen::Vector3d, 3> RandomTriangle(Random& random, const Eigen::Vector3d& centre,
                                                     double size) {
  std::array<Eigen::Vector3d, 3> t;
  for (Eigen::Vector3d& corner : t) corner = centre + size * random.UnitVector();
  return t;
}

/// Of `kind` 0 on the unit sphere, 1 in the unit ball, 2 on an ellipsoid (often a needle or a
/// sheet), 3 on lines in a plane, 4 on a line, most of them several times.
inline std::vector<Eigen::Vector3d> RandomPoints(Random& random, std::size_t count, int kind) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Vector3d stretch(1, random.LogUniform(1e-6, 1), random.Uniform(0, 1));
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p = random.UnitVector();
    if (kind == 1) p = random.Uniform(0, 1) * p;
    if (kind == 2) p = stretch.cwiseProduct(p);
    if (kind == 3) p = Eigen::Vector3d(static_cast<double>(random.Below(4)), p.y(), 0);
    if (kind == 4) p = Eigen::Vector3d(static_cast<double>(random.Below(3)), 0, 0);
    points.push_back(p);
  }
  return points;
}

}  // namespace collision
