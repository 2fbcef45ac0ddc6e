// The orientation of an agent over a stretch of time, and how far it may be off.
#pragma once

#include "collision_core/motion/space_time_bound.h"
#include "collision_core/numeric/rotation.h"

namespace collision {

/// With δ the seconds after a base instant: the orientation predicted with constant ω is
///   exp(ω (since + δ)) q,
/// and the true one is turned against it by at most
///   θ(δ) = ε_R + |ω| κ + ½ α σ (σ + h),   σ = |since + δ| + κ;
/// π, which says nothing, where α is not declared. As for positions (space_time_bound.h) the bound
/// holds forward from the stamp to the next discontinuity and backward to the last.
struct MovingTurn {
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  Eigen::Vector3d w_WB = Eigen::Vector3d::Zero();
  Interval since;       ///< Seconds from the stamp to the base instant.
  Quadratic off_angle;  ///< θ(δ).

  IntervalQuaternion OrientationAt(double delta) const {
    return Turned(q_WB, w_WB, since + Interval(delta));
  }
};

/// From `base` on. Requires base >= state.stamp.
MovingTurn ForwardTurn(const SpaceTimeBound& bound, Instant base);

/// From `base` on, valid while base + δ <= state.stamp. Requires base <= state.stamp.
MovingTurn BackwardTurn(const SpaceTimeBound& bound, Instant base);

}  // namespace collision
