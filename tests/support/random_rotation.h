// Rotations drawn from the tests' source of random numbers.
#pragma once

#include <Eigen/Geometry>

#include "tests/support/random.h"

namespace collision {

/// A rotation, all equally likely: a quaternion drawn in the unit ball, away from its centre.
inline Eigen::Matrix3d RandomRotation(Random& random) {
  for (;;) {
    // One statement each: compilers evaluate arguments in different orders.
    const double z = random.Uniform(-1, 1);
    const double y = random.Uniform(-1, 1);
    const double x = random.Uniform(-1, 1);
    const double w = random.Uniform(-1, 1);
    const Eigen::Quaterniond q(w, x, y, z);
    const double norm = q.norm();
    if (norm > 0.1 && norm <= 1) return q.normalized().toRotationMatrix();
  }
}

}  // namespace collision
