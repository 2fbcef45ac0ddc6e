// The orientation of an agent over a stretch of time, and how far it may be off.
#pragma once

#include "collision_core/motion/space_time_bound.h"
#include "collision_core/numeric/rotation.h"

namespace collision::motion {

/// The orientation of an agent as a function of the seconds δ after a base instant. The prediction
/// has constant angular velocity ω (world frame):
///
///   exp(ω (since + δ)) q.
///
/// The true orientation is turned against it by an angle of at most
///
///   θ(δ) = ε_R + |ω| κ + ½ α σ (σ + h) [rad],   σ = |since + δ| + κ,
///
/// or at most π, which is no restriction, if α is not declared. Like the bound on positions
/// (space_time_bound.h) it holds forward from the stamp to the next discontinuity and backward to
/// the last. It is evaluated only for agents that have, or will have, a shape.
///
/// Derivation. The angle Φ between two orientations is a metric that does not change when one
/// rotation is applied to both, from either side.
/// - α: in dt the angle Φ to the prediction grows by at most Φ(exp(ω(t) dt), exp(ω dt)) = |ω(t) −
///   ω| dt <= α τ dt, which integrates to ½ α τ².
/// - h: the integrator turns by exp(ω_k h) each step, ω_k = ω_{k−1} + a_k h. Step k adds at most α
///   k h², together ½ α τ (τ + h). A sender that turns at a constant rate between two steps is
///   ahead by up to α h² / 8 more there and should declare that as part of ε_R. Approximate turning
///   (a quaternion's derivative times h) is off by (|ω| h)³ / 12 in each step, which α does not
///   explain.
/// - ε_R and κ: as for positions; a rotation leaves the angle of an error as it is.
struct MovingRotation {
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  Eigen::Vector3d w_WB = Eigen::Vector3d::Zero();
  numeric::Interval since;     ///< Seconds from the stamp to the base instant.
  numeric::Cubic angle_error;  ///< θ(δ).

  numeric::IntervalQuaternion OrientationAt(double delta) const {
    return Turned(q_WB, w_WB, since + numeric::Interval(delta));
  }
};

/// The orientation from `base` on. Requires base >= state.stamp.
MovingRotation ForwardRotation(const SpaceTimeBound& bound, Instant base);

/// From `base` on, valid while base + δ <= state.stamp. Requires base <= state.stamp.
MovingRotation BackwardRotation(const SpaceTimeBound& bound, Instant base);

}  // namespace collision::motion
