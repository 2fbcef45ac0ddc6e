// Rotations whose error is known.
#pragma once

#include <Eigen/Geometry>

#include "collision_core/numeric/interval.h"

namespace collision {

/// sin x and cos x for every x of the interval; no library function is called, so that every
/// platform gives the same bits. |x| up to kTurnMax; beyond, [-1, 1].
struct SinCos {
  Interval sin, cos;
};
SinCos SinCosOf(Interval x);

/// Angles beyond this [rad] are not followed: a million radians lose six digits.
inline constexpr double kTurnMax = 1e6;

/// w, x, y, z; contains an exact unit quaternion.
struct IntervalQuaternion {
  Interval w, x, y, z;
};

/// The exact rotation that `q` names: q / |q|. Requires a finite q, not zero.
IntervalQuaternion UnitQuaternion(const Eigen::Quaterniond& q);

/// The orientation after turning from `q` with constant angular velocity `w_WB` (in the world
/// frame) for `seconds` (negative: before): exp(w τ) q, for every τ of the interval. Everything
/// (all components [-1, 1]) if |w τ| may exceed kTurnMax.
IntervalQuaternion Turned(const Eigen::Quaterniond& q, const Eigen::Vector3d& w_WB,
                          Interval seconds);

/// The angle in [0, π] of the rotation that leads from one orientation to the other.
Interval AngleBetween(const IntervalQuaternion& a, const IntervalQuaternion& b);

/// A rotation matrix in doubles: for every orientation of the quaternion's intervals and every
/// vector x, |matrix x − R x| <= error |x|, with the matrix-vector product still exact.
struct Rotation {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  double error = 0;
};
Rotation RotationOf(const IntervalQuaternion& q);

}  // namespace collision
