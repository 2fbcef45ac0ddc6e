// How the points of two swept bodies move, and how much of a gap between them may be used up.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "collision_core/narrow_phase/advancement/swept_pose.h"

namespace collision::narrow_phase {

/// The velocities of two swept bodies' points, in the axes of A's body, and an upper bound of all
/// that is uncertain about the distance of two of them: rounding, the pose and the motion.
///
/// Rounding. All positions h seconds on are sums of a few terms at the start, and of h times a few
/// velocities (compare SlackOf() in posed_pair.h); what is lost grows with h, so that soon after
/// the start a time is known as well as the pose is. The offset counts in what turns as well: a
/// point of B is seen from B's reference point only after both were posed, each with its rounding.
/// What is not known of the motion needs no share: where it is more than the bodies are apart, they
/// may touch anyway.
class PointMotion {
 public:
  /// What `pair` refers to outlives this.
  explicit PointMotion(const SweptPair& pair);

  /// The velocity of the point of A that is at x at the start [m/s].
  Eigen::Vector3d VelocityOfA(const Eigen::Vector3d& x) const { return swept_.spin_A.cross(x); }
  /// The velocity of the point of B that is at y, in A's body frame, at the start [m/s].
  Eigen::Vector3d VelocityOfB(const Eigen::Vector3d& y) const {
    return swept_.velocity + swept_.spin_B.cross(y - swept_.pose.p_AB);
  }

  /// How much of a gap may be used up between points of A no farther than `far_a` [m] from its
  /// reference point and points of B no farther than `far_b` from its own: `radii` and all that is
  /// uncertain, as it grows with time.
  SweptPose::Growth UsedUp(double radii, double far_a, double far_b) const {
    const SweptPose::Growth &u = swept_.translation, &ta = swept_.turning_A;
    const SweptPose::Growth& tb = swept_.turning_B;
    return {radii + slack_ + u.c0 + ta.c0 * far_a + tb.c0 * far_b,
            slack_growth_ + swept_.velocity_error + u.c1 + ta.c1 * far_a + tb.c1 * far_b,
            std::max(0.0, u.c2 + ta.c2 * far_a + tb.c2 * far_b)};
  }
  /// The same for any two points of the bodies.
  SweptPose::Growth UsedUp() const { return UsedUp(0, reach_a_, reach_b_); }

  /// An upper bound of the predicted relative speed of any two points of the bodies [m/s].
  double fastest() const { return fastest_; }

 private:
  const SweptPose& swept_;
  const double reach_a_, reach_b_;       ///< Of the points that turning moves [m].
  double slack_ = 0, slack_growth_ = 0;  ///< Of rounding: at the start [m], and later [m/s].
  double fastest_ = 0;
};

}  // namespace collision::narrow_phase
