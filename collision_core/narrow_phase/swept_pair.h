// When two bodies may first touch, by their sphere trees in motion.
#pragma once

#include "collision_core/narrow_phase/separation.h"

namespace collision {

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

/// How far a search goes before it takes the time it has.
struct SweepDetail {
  /// Spheres are opened while they are larger than this share of what is not known of the motion.
  double fine_enough = 0.25;
  /// Steps shorter than this share of the duration are not worth another.
  double step_worth = 1e-3;
};

/// A lower bound on the time at which the two may touch.
struct FirstTouch {
  double seconds = 0;      ///< +infinity: not within the duration, its end included.
  bool exhausted = false;  ///< The work allowed is spent: it may be later.
  /// The leaves that may touch first, where the search went down to them.
  bool resolved = false;
  std::uint32_t leaf_A = 0;
  std::uint32_t leaf_B = 0;
};

/// Best-first over pairs of nodes by the time at which their moving balls may touch first; two leaves
/// by their triangles. A pair of balls or of triangles is convex, so that for each the direction
/// between the two may be used: bodies that pass by each other cost little.
FirstTouch TouchOf(const Surface& a, const Surface& b, const SweptPose& swept, double duration,
                   Work* work, const SweepDetail& detail = {});

}  // namespace collision
