// Rigid bodies that move in steps of constant acceleration and constant angular acceleration.
#pragma once

#include <cmath>
#include <cstdint>

#include "client/simulators/motion_log.h"
#include "client/simulators/random.h"
#include "client/types.h"

namespace collision::client {

inline Vector3 Sum(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 Difference(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector3 Scaled(const Vector3& v, double factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}
inline double Dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector3 Cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double Norm(const Vector3& v) { return std::sqrt(Dot(v, v)); }

/// v, made shorter if it is longer than `length`.
Vector3 AtMost(const Vector3& v, double length);

/// The vector with components `x_B` in the body, seen from the world.
Vector3 Rotated(const Quaternion& orientation, const Vector3& x_B);

/// Every orientation is equally likely.
Quaternion RandomOrientation(SeededRandom* random);

/// Where and how a body is.
struct RigidState {
  Vector3 position_m{};
  Vector3 velocity_m_s{};
  Quaternion orientation{1, 0, 0, 0};
  Vector3 angular_velocity_rad_s{};  ///< In W.
};

/// What a step did; both pieces have the same interval.
struct RigidStep {
  MotionPiece piece;
  TurnPiece turn;
};

/// The longest step [s] and the greatest |ω| [rad/s] and α [rad/s²] for which OrientationAt() is
/// made.
inline constexpr double kRigidStepMax = 0.1;
inline constexpr double kTurnSpeedMax = 10;
inline constexpr double kTurnAccelerationMax = 100;

/// How the turn stands at `stamp_ns`, by the power series of q' = ½ ω q; within 1e-15 of the exact
/// solution, rounding apart.
Quaternion OrientationAt(const TurnPiece& turn, std::int64_t stamp_ns);

Vector3 AngularVelocityAt(const TurnPiece& turn, std::int64_t stamp_ns);

/// α, and how fast a body may turn.
struct TurnLimits {
  double angular_acceleration_max_rad_s2 = 2;
  double angular_speed_max_rad_s = 2;  ///< Never exceeded; at most kTurnSpeedMax.
};

/// A step that comes as near to `angular_velocity_wanted` as the limits let it: |Δω| <= α h also in
/// exact arithmetic.
TurnPiece TurnTowards(const RigidState& state, const Vector3& angular_velocity_wanted_rad_s,
                      const TurnLimits& limits, std::int64_t t0_ns, std::int64_t t1_ns);

/// The time [s] in which a body that turns at `angular_speed` now, and changes that by at most
/// `angular_acceleration_max`, certainly turns by less than a quarter: the root of
/// |ω| τ + ½ α τ² = π/2, rounded down. Infinite if it does not turn.
double QuarterTurnSeconds(double angular_speed_rad_s, double angular_acceleration_max_rad_s2);

}  // namespace collision::client
