// Rotations whose error is known.
#pragma once

#include <Eigen/Geometry>

#include "collision_core/numeric/interval.h"

namespace collision::numeric {

/// sin x and cos x for every x of the interval [rad], each known to about 1.2e-15. No library
/// function is called, so every platform gives the same bits. For |x| beyond kRotationAngleMax both
/// are [−1, 1].
struct SinCos {
  Interval sin, cos;
};
/// See SinCos.
SinCos SinCosOf(Interval x);

/// Angles beyond this [rad] are not followed: at a million radians six digits are lost.
inline constexpr double kRotationAngleMax = 1e6;

/// Contains an exact unit quaternion; body to world.
struct IntervalQuaternion {
  Interval w, x, y, z;
};

/// The exact rotation that `q` names: q / |q|. Requires a finite q, not zero.
IntervalQuaternion UnitQuaternion(const Eigen::Quaterniond& q);

/// The orientation after turning from `q` with constant angular velocity `w_WB` (in the world
/// frame) for `seconds` (negative: before): exp(w τ) q, for every τ of the interval. Everything
/// (all components [-1, 1]) if |w τ| may exceed kRotationAngleMax.
IntervalQuaternion Turned(const Eigen::Quaterniond& q, const Eigen::Vector3d& w_WB,
                          Interval seconds);

/// The angle in [0, π] of the rotation that leads from one orientation to the other.
Interval AngleBetween(const IntervalQuaternion& a, const IntervalQuaternion& b);

/// A rotation matrix in doubles: for every orientation of the quaternion's intervals and every
/// vector x, |matrix x − R x| <= error |x|. This counts the error of the entries only; the rounding
/// of a computed product matrix · x comes on top.
struct Rotation {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  double error = 0;
};
/// The matrix of a quaternion; its error is about 4e-15 for angles up to kRotationAngleMax.
Rotation RotationOf(const IntervalQuaternion& q);

}  // namespace collision::numeric
