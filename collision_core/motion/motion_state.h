// What the owner of an agent reports: its state, and the bounds of its motion.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "collision_core/base/instant.h"
#include "collision_core/numeric/rounding.h"

namespace collision::motion {

/// An agent's last state, as its owner reported it. World frame W, body frame B, SI units. Values
/// are trusted here: the server's codec refuses bad input with a reason. Unchecked: numbers are
/// finite, errors >= 0, and the quaternion is not zero.
struct MotionState {
  Instant stamp;                                   ///< When the state held, by the sender's clock.
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();  ///< Reference point [m].
  Eigen::Vector3d v_WA = Eigen::Vector3d::Zero();  ///< Its velocity [m/s].
  /// The acceleration that its owner knows [m/s²]: gravity, thrust, braking. Zero: none is known.
  Eigen::Vector3d a_WA = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();  ///< Orientation, body to world.
  Eigen::Vector3d w_WB = Eigen::Vector3d::Zero();            ///< Angular velocity, in W [rad/s].
  double position_error = 0;  ///< |true − p_WA| is at most this [m].
  double velocity_error = 0;  ///< |true − v_WA| is at most this [m/s].
  double rotation_error = 0;  ///< Angle between true and q_WB, at most [rad].
  /// Unit vector d with (acceleration − a_WA)·d >= 0 until `direction_until`; zero: not declared.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Instant direction_until = Instant::Never();
  Instant expiry = Instant::Never();  ///< Promises exclude the agent from then on.
  bool discontinuity = false;         ///< The motion jumped here; no breach.
};

/// Whether the owner knows an acceleration.
inline bool HasKnownAcceleration(const MotionState& state) { return !state.a_WA.isZero(0); }

/// What the owner declares about an agent's motion once, and what then holds from state to state.
struct MotionLimits {
  /// r: radius of a ball about the reference point that contains the agent in every orientation
  /// [m], >= 0.
  double radius = 0;
  /// D [m/s²], >= 0: |acceleration − a_WA| is at most D + J |t − stamp|. Where no acceleration is
  /// known it is the greatest acceleration, Hubbard's M.
  double acceleration_max = 0;
  double jerk_max = 0;   ///< J [m/s³], >= 0: how fast what is known ages.
  double time_step = 0;  ///< h of an Euler integrator, of either kind [s]; 0: continuous.
  /// V: |velocity| of the reference point never exceeds it [m/s], >= 0; +infinity: not declared.
  /// speed_cap.h says how it changes the bound, and why any change of a declared cap is a widening.
  double speed_max = numeric::kInfinity;
  /// α >= |angular acceleration| [rad/s²], gyroscopic terms included; < 0: not declared, then
  /// nothing is known of the orientation between two states. Counts for shapes only.
  double angular_acceleration_max = -1;

  friend bool operator==(const MotionLimits&, const MotionLimits&) = default;
};

/// The larger of two bounds on the angular acceleration; < 0 (not declared) if either is.
inline double WiderAngularBound(double a, double b) { return a < 0 || b < 0 ? -1 : a < b ? b : a; }

/// Limits that allow every motion that either of the two allows.
inline MotionLimits Wider(const MotionLimits& a, const MotionLimits& b) {
  return {.radius = std::max(a.radius, b.radius),
          .acceleration_max = std::max(a.acceleration_max, b.acceleration_max),
          .jerk_max = std::max(a.jerk_max, b.jerk_max),
          .time_step = std::max(a.time_step, b.time_step),
          .speed_max = std::max(a.speed_max, b.speed_max),
          .angular_acceleration_max =
              WiderAngularBound(a.angular_acceleration_max, b.angular_acceleration_max)};
}

}  // namespace collision::motion
