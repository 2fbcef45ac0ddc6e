// Motions of rigid bodies in long double, written from the definitions and not from the code: with
// true_distance.h the oracle of the narrow phase.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "collision_core/motion/space_time_bound.h"
#include "tests/support/random.h"

namespace collision {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Quaternion = Eigen::Quaternion<Real>;

/// exp(rotation vector).
inline Quaternion Exponential(const Vector& w) {
  const Real angle = w.norm();
  if (angle == 0) return Quaternion::Identity();
  const Vector n = w / angle * std::sin(angle / 2);
  return {std::cos(angle / 2), n.x(), n.y(), n.z()};
}

/// Position, velocities and rotation of a body at one instant, in the world frame.
struct TruePose {
  Vector p = Vector::Zero(), v = Vector::Zero(), w = Vector::Zero();
  Quaternion q = Quaternion::Identity();

  Vector ToWorld(const Eigen::Vector3d& x) const { return p + q * x.cast<Real>().eval(); }
};

/// Accelerations that are constant in pieces. The rotation is integrated in long double: per step
/// the midpoint's angular velocity and the first term of Magnus' series, off by O(h⁵) a step.
class TrueMotion {
 public:
  struct Piece {
    Real until;
    Vector acceleration, angular;
  };
  TruePose start;
  std::vector<Piece> pieces;

  TruePose At(Real t) const {
    TruePose pose = start;
    Real from = 0;
    for (const Piece& piece : pieces) {
      const Real to = std::min(t, piece.until);
      if (to > from) Follow(piece, to - from, &pose);
      from = std::max(from, to);
    }
    if (t > from) Follow({t, Vector::Zero(), Vector::Zero()}, t - from, &pose);
    return pose;
  }

 private:
  static void Follow(const Piece& piece, Real s, TruePose* pose) {
    pose->p += s * pose->v + s * s / 2 * piece.acceleration;
    pose->v += s * piece.acceleration;
    const Real angle = (pose->w.norm() + piece.angular.norm() * s) * s;
    const int steps = piece.angular.isZero(0) ? 1 : 8 + static_cast<int>(200 * angle);
    const Real h = s / steps;
    for (int i = 0; i < steps; ++i) {
      const Vector middle = pose->w + h / 2 * piece.angular;
      // Ω = h ω_mid + h³/12 (α × ω), for dq/dt = ½ ω q with ω in the world.
      pose->q = Exponential(h * middle + h * h * h / 12 * piece.angular.cross(pose->w)) * pose->q;
      pose->q.normalize();
      pose->w += h * piece.angular;
    }
  }
};

inline Vector RandomUnit(Random& random) { return random.UnitVector().cast<Real>(); }

inline Quaternion RandomTurn(Random& random) {
  return Exponential(random.Uniform(0, 3.14159) * RandomUnit(random));
}

/// An agent that moves so, as given by a state at `stamp` seconds, with what rounding to doubles
/// costs declared.
inline motion::SpaceTimeBound BoundAt(const TrueMotion& motion, double stamp,
                                      const motion::MotionLimits& limits) {
  const TruePose pose = motion.At(stamp);
  motion::SpaceTimeBound bound;
  bound.state.stamp =
      Instant::FromNanoseconds(static_cast<std::int64_t>(std::llround(stamp * 1e9)));
  bound.state.p_WA = pose.p.cast<double>();
  bound.state.v_WA = pose.v.cast<double>();
  bound.state.q_WB = pose.q.cast<double>();
  bound.state.w_WB = pose.w.cast<double>();
  const double size = static_cast<double>(pose.p.norm());
  bound.state.position_error = 1e-15 * size;
  bound.state.velocity_error = 1e-15 * static_cast<double>(pose.v.norm());
  bound.state.rotation_error = 1e-15;
  bound.limits = limits;
  return bound;
}

}  // namespace collision
