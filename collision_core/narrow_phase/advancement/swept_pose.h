// Two bodies from an instant on: the pose, the velocities, and how the uncertainty grows.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"

namespace collision::narrow_phase {

/// Two bodies from an instant on, h seconds later (or, where time runs backward, earlier), seen in
/// the axes of A's body at that instant and from A's reference point: a point x of B that is at
/// y = pose.ToA(x) moves with velocity + spin_B × (y − offset), a point x of A with spin_A × x.
/// Turning with constant ω a point leaves its tangent by at most ½ |ω|² |x| h².
struct SweptPose {
  RelativePose pose;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< Of B's reference point [m/s].
  Eigen::Vector3d spin_A = Eigen::Vector3d::Zero();    ///< [rad/s]
  Eigen::Vector3d spin_B = Eigen::Vector3d::Zero();
  double velocity_error = 0;  ///< Of any point's velocity, as computed from these [m/s].

  /// c0 + c1 h + c2 h²; coefficients rounded up.
  struct Growth {
    double c0 = 0, c1 = 0, c2 = 0;
  };
  Growth translation;           ///< Uncertainty of translation [m].
  Growth turning_A, turning_B;  ///< Of turning, tangents' deviation included [m per m of |x|].
};

/// The trees of A and B and how the two move. What it refers to outlives it.
struct SweptPair {
  const BodyTree& a;
  const BodyTree& b;
  const SweptPose& swept;
};

}  // namespace collision::narrow_phase
