#include "collision_core/intersection/overlap_estimate.h"

#include <algorithm>
#include <cmath>

#include "collision_core/numeric/seconds.h"

namespace collision::intersection {
namespace {

double Seconds(Instant from, Instant to) {
  return (static_cast<double>(to.nanoseconds()) - static_cast<double>(from.nanoseconds())) *
         numeric::kNanosecond;
}

double Square(double x) { return x * x; }

/// Times are certified from below, so that nothing quite overlaps at them yet; this much later it
/// does, and an answer may be early by as much: less than 1e-9.
constexpr double kAhead = 1 + 0x1p-30;

/// One agent's bounds at one time, from p_WA.
struct Estimate {
  const motion::SpaceTimeBound& bound;
  double tau;
  double skew_reach = 0;  // |v| κ.
  double centre[3];       // Of the horn's ball.
  double radius;
  double capped_centre[3];
  double capped_radius;
  double up[3], down[3];  // The box's faces.

  Estimate(const motion::SpaceTimeBound& given, Instant base, double time)
      : bound(given), tau(Seconds(bound.state.stamp, base) + time) {
    const motion::MotionState& state = bound.state;
    const bool capped = bound.limits.speed_max < numeric::kInfinity;
    double speed = 0;
    if (capped || bound.skew > 0) speed = state.v_WA.norm();
    skew_reach = speed * bound.skew;
    radius = bound.limits.radius + U(tau, 1);
    const double takeover = capped ? TakesOver(speed, 1) : numeric::kInfinity;
    capped_radius = tau <= takeover
                        ? radius
                        : bound.limits.radius + U(takeover, 1) + CappedSpeed() * (tau - takeover);
    const bool directed = !state.direction.isZero(0) && DirectionHoldsFor(bound, base) > time;
    for (int i = 0; i < 3; ++i) {
      centre[i] = state.v_WA[i] * tau;
      capped_centre[i] = state.v_WA[i] * std::min(tau, takeover);
      up[i] = Face(state.v_WA[i], directed ? Fraction(i, 1) : 1);
      down[i] = Face(-state.v_WA[i], directed ? Fraction(i, -1) : 1);
    }
  }

  double CappedSpeed() const {
    const motion::MotionLimits& d = bound.limits;
    return d.speed_max + 0.5 * d.acceleration_max * d.time_step;
  }

  /// u at τ, with a fraction of the deviation.
  double U(double at, double fraction) const {
    const motion::MotionLimits& d = bound.limits;
    const double sigma = at + bound.skew;
    return bound.state.position_error + skew_reach + bound.state.velocity_error * sigma +
           fraction * (0.5 * d.acceleration_max * sigma * (sigma + d.time_step));
  }

  /// The time since the stamp when the cap takes over from the slope `along`.
  double TakesOver(double along, double fraction) const {
    const motion::MotionLimits& d = bound.limits;
    const double rate = fraction * d.acceleration_max;
    const double room = d.speed_max - along - bound.state.velocity_error +
                        0.5 * d.time_step * (d.acceleration_max - rate);
    if (rate * (tau + bound.skew) <= room) return numeric::kInfinity;
    return std::max(0.0, room / rate - bound.skew);
  }

  double Fraction(int axis, int sign) const {
    const Eigen::Vector3d& d = bound.state.direction;
    if (sign * d[axis] >= 0) return 1;
    return std::sqrt(1 - Square(d[axis]) / d.squaredNorm());
  }

  double Face(double along, double fraction) const {
    double reach = along * tau + U(tau, fraction);
    if (bound.limits.speed_max < numeric::kInfinity) {
      const double takeover = TakesOver(along, fraction);
      if (tau > takeover) {
        reach = along * takeover + U(takeover, fraction) + CappedSpeed() * (tau - takeover);
      }
    }
    return bound.limits.radius + reach;
  }
};

bool Within(const double (&p)[3], const double (&of_A)[3], const double (&of_B)[3], double reach) {
  double square = 0;
  for (int i = 0; i < 3; ++i) square += Square(p[i] + (of_B[i] - of_A[i]));
  return square <= Square(reach);
}

}  // namespace

bool SeemToOverlap(const BoundPair& pair, double time) {
  const auto& [a, b, base, margin] = pair;
  const Estimate at_A(a, base, time * kAhead), at_B(b, base, time * kAhead);
  double p[3];
  for (int i = 0; i < 3; ++i) {
    p[i] = b.state.p_WA[i] - a.state.p_WA[i];
    if (p[i] > at_A.up[i] + at_B.down[i] + margin) return false;
    if (-p[i] > at_A.down[i] + at_B.up[i] + margin) return false;
  }
  return Within(p, at_A.capped_centre, at_B.capped_centre,
                at_A.capped_radius + at_B.capped_radius + margin) &&
         Within(p, at_A.capped_centre, at_B.centre, at_A.capped_radius + at_B.radius + margin) &&
         Within(p, at_A.centre, at_B.capped_centre, at_A.radius + at_B.capped_radius + margin);
}

}  // namespace collision::intersection
