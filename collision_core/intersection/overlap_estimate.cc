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
  double known = 0;       // |a|.
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
    if (HasKnownAcceleration(state)) known = state.a_WA.norm();
    radius = bound.limits.radius + U(tau, 1);
    const double takeover = capped ? TakesOver(speed, known, 1) : numeric::kInfinity;
    capped_radius = tau <= takeover
                        ? radius
                        : bound.limits.radius + U(takeover, 1) + CappedSpeed() * (tau - takeover);
    const bool directed = !state.direction.isZero(0) && DirectionHoldsFor(bound, base) > time;
    for (int i = 0; i < 3; ++i) {
      centre[i] = Path(state.v_WA[i], state.a_WA[i], tau);
      capped_centre[i] = Path(state.v_WA[i], state.a_WA[i], std::min(tau, takeover));
      up[i] = Face(state.v_WA[i], state.a_WA[i], directed ? Fraction(i, 1) : 1);
      down[i] = Face(-state.v_WA[i], -state.a_WA[i], directed ? Fraction(i, -1) : 1);
    }
  }

  static double Path(double along, double bending, double at) {
    return along * at + 0.5 * bending * at * at;
  }

  double CappedSpeed() const {
    const motion::MotionLimits& d = bound.limits;
    if (d.jerk_max > 0) return (d.time_step > 0 ? 2 : 1) * d.speed_max;
    return d.speed_max + 0.5 * (d.acceleration_max + known) * d.time_step;
  }

  /// u at τ, with a fraction of the deviation.
  double U(double at, double fraction) const {
    const motion::MotionLimits& d = bound.limits;
    const double sigma = at + bound.skew;
    const double h = d.time_step;
    const double jerked = d.jerk_max / 6 * sigma * (sigma * sigma + 3 * h * (sigma + h));
    return bound.state.position_error + skew_reach +
           (bound.state.velocity_error + known * (bound.skew + 0.5 * h)) * sigma +
           fraction * (0.5 * d.acceleration_max * sigma * (sigma + h) + jerked);
  }

  /// The time since the stamp when the cap takes over from a slope that is `along` at the stamp and
  /// grows at the rate `bending` by itself.
  double TakesOver(double along, double bending, double fraction) const {
    const motion::MotionLimits& d = bound.limits;
    const double jerk = fraction * d.jerk_max, earlier = 2 * bound.skew + d.time_step;
    const double rate = fraction * d.acceleration_max + bending + jerk * earlier;
    const double room = d.speed_max - along - bound.state.velocity_error +
                        0.5 * d.time_step * (d.acceleration_max - fraction * d.acceleration_max) -
                        0.5 * jerk * Square(earlier);
    const double sigma = tau + bound.skew;
    if ((rate + 0.5 * jerk * sigma) * sigma <= room) return numeric::kInfinity;
    const double closing = std::max(0.0, room);
    return std::max(
        0.0, 2 * closing / (rate + std::sqrt(Square(rate) + 2 * jerk * closing)) - bound.skew);
  }

  double Fraction(int axis, int sign) const {
    const Eigen::Vector3d& d = bound.state.direction;
    if (sign * d[axis] >= 0) return 1;
    return std::sqrt(1 - Square(d[axis]) / d.squaredNorm());
  }

  double Face(double along, double bending, double fraction) const {
    double reach = Path(along, bending, tau) + U(tau, fraction);
    if (bound.limits.speed_max < numeric::kInfinity) {
      const double takeover =
          TakesOver(along + known * bound.skew, std::max(0.0, bending), fraction);
      if (tau > takeover) {
        reach = Path(along, bending, takeover) + U(takeover, fraction) +
                CappedSpeed() * (tau - takeover);
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
