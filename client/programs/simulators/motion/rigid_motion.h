// Rigid bodies that move in steps of constant acceleration and constant angular acceleration.
#pragma once

#include <cstdint>

#include "client/library/vector.h"
#include "client/programs/simulators/motion/motion_log.h"
#include "client/programs/simulators/motion/random.h"
#include "collision/types.h"

namespace collision::client {

/// v, shortened if it is longer than `length`.
Vector3 AtMost(const Vector3& v, double length);

/// The vector with components `x_B` in body axes, in world axes.
Vector3 Rotated(const Quaternion& orientation, const Vector3& x_B);

/// Uniformly distributed over all orientations.
Quaternion RandomOrientation(SeededRandom* random);

/// Position, orientation and velocities of a body.
struct RigidState {
  Vector3 position_m{};
  Vector3 velocity_m_s{};
  Quaternion orientation{1, 0, 0, 0};
  Vector3 angular_velocity_rad_s{};  ///< In W.
};

/// The motion of one step; both pieces have the same interval.
struct RigidStep {
  MotionPiece piece;
  TurnPiece turn;
};

/// The longest step [s] and the greatest |ω| [rad/s] and α [rad/s²] for which the error of
/// OrientationAt() holds.
inline constexpr double kRigidStepMax = 0.1;
inline constexpr double kTurnSpeedMax = 10;
inline constexpr double kTurnAccelerationMax = 100;

/// The orientation at `stamp_ns`, by the power series of q' = ½ ω q; within 1e-15 of the exact
/// solution, apart from rounding.
Quaternion OrientationAt(const TurnPiece& turn, std::int64_t stamp_ns);

Vector3 AngularVelocityAt(const TurnPiece& turn, std::int64_t stamp_ns);

/// How fast a body may turn, and how fast it may change that.
struct TurnLimits {
  double angular_acceleration_max_rad_s2 = 2;
  double angular_speed_max_rad_s = 2;  ///< Never exceeded; at most kTurnSpeedMax.
};

/// A step that comes as near to `angular_velocity_wanted_rad_s` as the limits allow: |Δω| <= α h
/// also in exact arithmetic.
TurnPiece TurnTowards(const RigidState& state, const Vector3& angular_velocity_wanted_rad_s,
                      const TurnLimits& limits, std::int64_t t0_ns, std::int64_t t1_ns);

/// The time [s] in which a body that turns at `angular_speed_rad_s` now, and changes that by at
/// most `angular_acceleration_max_rad_s2`, certainly turns by less than a quarter: the root of
/// |ω| τ + ½ α τ² = π/2, rounded down. Infinite if it does not turn.
double QuarterTurnSeconds(double angular_speed_rad_s, double angular_acceleration_max_rad_s2);

}  // namespace collision::client
