// Random poses, and where they take a point, in exact arithmetic.
#pragma once

#include <Eigen/Geometry>

#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision::narrow_phase {

inline Eigen::Matrix3d RandomMatrix(Random& random) {
  return Eigen::AngleAxisd(random.Uniform(0, 3.14), random.UnitVector()).toRotationMatrix();
}

/// The exact place of a ball's centre or a corner of B, in A's body frame.
inline ExactVector ExactlyPosed(const RelativePose& pose, const ExactVector& p) {
  const auto row = [&](int i) {
    return Exact(pose.R_AB(i, 0)) * p.x + Exact(pose.R_AB(i, 1)) * p.y +
           Exact(pose.R_AB(i, 2)) * p.z + Exact(pose.p_AB[i]);
  };
  return {row(0), row(1), row(2)};
}

}  // namespace collision::narrow_phase
