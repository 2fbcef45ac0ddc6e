#include "collision_core/motion/contract_between.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

using Eigen::Vector3d;

/// Newton's steps at most: about 6 for a simple root, about 50 for a double one.
constexpr int kStepsMax = 60;

/// A step of a smaller part of the way moves the gap by less than it is rounded.
constexpr double kProgressMin = 0x1p-40;

/// D and R over x = s / T, in plain doubles: they only choose the instant that is tested.
///   D = from + (to − from) x,   R = r0 + r1 x + r2 x²,   0 <= x <= 1.
struct Span {
  Vector3d from, to;
  double r0, r1, r2;

  double RadiiAt(double x) const { return r0 + x * (r1 + x * r2); }
  Vector3d OffsetAt(double x) const { return (1 - x) * from + x * to; }
  double GapAt(double x) const { return OffsetAt(x).norm() - RadiiAt(x); }
  Span Reversed() const { return {to, from, RadiiAt(1), -r1 - 2 * r2, r2}; }
  Span Scaled(double by) const { return {by * from, by * to, by * r0, by * r1, by * r2}; }
};

Span SpanOf(const SpaceTimeBound& before, const MotionState& next, double duration) {
  const MotionState& old = before.state;
  const double acceleration_max = before.limits.acceleration_max;
  const double step = before.limits.time_step, skew = before.skew;
  const double whole = duration + skew;
  const Vector3d back = old.p_WA - next.p_WA;
  const double speeds = skew > 0 ? old.v_WA.norm() + next.v_WA.norm() : 0;
  const double r0 = old.position_error + next.position_error + speeds * skew +
                    old.velocity_error * skew + next.velocity_error * whole +
                    0.5 * acceleration_max * (skew * (skew + step) + whole * (whole + step));
  const double square = acceleration_max * duration * duration;
  return {back + duration * next.v_WA, back + duration * old.v_WA, r0,
          duration * (old.velocity_error - next.velocity_error) - square, square};
}

/// Whether the balls certainly never come apart: the greatest |D|, in a norm that cannot overflow,
/// is not larger than the least R.
bool NeverComeApart(const Span& span) {
  const double farthest = std::max(span.from.lpNorm<1>(), span.to.lpNorm<1>());
  const double lowest = span.r2 > 0 ? std::clamp(-span.r1 / (2 * span.r2), 0.0, 1.0) : 0;
  return farthest <= std::min(span.RadiiAt(lowest), span.RadiiAt(1));
}

/// The power of two that takes the largest number in it near 1; 2^1000 at most.
double Enlarging(const Span& span) {
  const double largest = std::max({span.from.cwiseAbs().maxCoeff(), span.to.cwiseAbs().maxCoeff(),
                                   std::abs(span.r0), std::abs(span.r1), span.r2});
  return std::isfinite(largest) && largest > 0
             ? std::ldexp(1.0, std::min(1000, -std::ilogb(largest)))
             : 0;
}

/// Where the gap is greatest after the centres are nearest. There |D|' is concave (as x / √(x² +
/// q²) for x >= 0) and R' linear, so |D|' − R' turns from above 0 to below it once at most, and
/// Newton's method comes down to there from the end without ever passing it. If it does not turn,
/// the gap is greatest at one of the ends.
double FarthestAfterNearest(const Span& span) {
  const Vector3d w = span.to - span.from;
  const double square = w.squaredNorm(), across = span.from.cross(w).squaredNorm();
  const double nearest = square > 0 ? std::clamp(-span.from.dot(w) / square, 0.0, 1.0) : 0;
  double x = 1;
  for (int i = 0; i < kStepsMax; ++i) {
    const Vector3d d = span.OffsetAt(x);
    const double length = d.norm();
    if (!(length > 0)) return nearest;
    const double slope = d.dot(w) / length - (span.r1 + 2 * span.r2 * x);
    const double bend = across / (length * length * length) - 2 * span.r2;
    if (slope >= 0) return x;
    const double next = x - slope / bend;
    if (!(bend < 0 && next > nearest)) return nearest;
    if (x - next <= kProgressMin) return next;
    x = next;
  }
  return x;
}

/// The share of the time between at which the balls are farthest apart; below 0 if they always
/// meet.
double FarthestOf(const Span& span) {
  double best = -1, greatest = 0;
  for (const double x :
       {0.0, 1.0, FarthestAfterNearest(span), 1 - FarthestAfterNearest(span.Reversed())}) {
    const double gap = span.GapAt(x);
    if (gap > greatest) best = x, greatest = gap;
  }
  return best;
}

/// Instants tried between two states where the centres bend, and how often the best one's
/// neighbourhood is halved.
constexpr int kInstantsTried = 32;
constexpr int kHalvings = 20;

/// As FarthestOf(), of any two balls: the best of a few instants, then nearer ones.
double FarthestOfBent(const numeric::MovingBall& forward, const numeric::MovingBall& backward,
                      double duration) {
  const Vector3d d = (forward.centre() - backward.centre()).middle();
  const Vector3d w = (forward.velocity - backward.velocity).middle();
  const Vector3d h = (forward.bend - backward.bend).middle();
  const numeric::Cubic radii = forward.u + backward.u;
  const double r0 = radii.c0.middle(), r1 = radii.c1.middle(), r2 = radii.c2.middle(),
               r3 = radii.c3.middle();
  const auto gap_at = [&](double share) {
    const double s = share * duration;
    return (d + s * (w + s * h)).norm() - (r0 + s * (r1 + s * (r2 + s * r3)));
  };
  double best = 0, greatest = gap_at(0);
  const auto try_at = [&](double share) {
    if (share < 0 || share > 1) return;
    const double gap = gap_at(share);
    if (gap > greatest) best = share, greatest = gap;
  };
  for (int i = 1; i <= kInstantsTried; ++i) try_at(static_cast<double>(i) / kInstantsTried);
  double apart = 0.5 / kInstantsTried;
  for (int i = 0; i < kHalvings; ++i, apart *= 0.5) {
    const double middle = best;
    try_at(middle - apart);
    try_at(middle + apart);
  }
  return greatest > 0 ? best : -1;
}

}  // namespace

// Neither skew nor what came before the one state and comes after the other can make it wrong: let
// the true motion go on evenly beyond both. It is still under the declaration, the states' true
// instants lie within κ of their stamps, and both horns hold for it at every instant.
double GapBetween(const SpaceTimeBound& before, const MotionState& next) {
  const Instant base = before.state.stamp;
  CORE_CHECK(next.stamp >= base, "a state follows the one before", next.stamp.nanoseconds(),
             base.nanoseconds());
  const numeric::Interval duration = numeric::SecondsBetween(base, next.stamp);
  const SpaceTimeBound after{next, before.limits, before.skew};
  const bool bends = Bends(before) || Bends(after);
  double share;
  if (!bends) {
    const Span span = SpanOf(before, next, duration.middle());
    if (NeverComeApart(span)) return 0;
    share = FarthestOf(span.Scaled(Enlarging(span)));
    if (share < 0) return 0;
  }
  const numeric::MovingBall forward = ForwardBall(before, base);
  const numeric::MovingBall backward = BackwardBall(after, base);
  if (bends) {
    share = FarthestOfBent(forward, backward, duration.middle());
    if (share < 0) return 0;
  }
  const double s = std::min(share * duration.lower, duration.lower);
  numeric::IntervalVector offset = (forward.centre() - backward.centre()) +
                                   numeric::Interval(s) * (forward.velocity - backward.velocity);
  if (bends) offset = offset + Square(numeric::Interval(s)) * (forward.bend - backward.bend);
  return std::max(0.0, (numeric::Norm(offset) - (forward.u + backward.u).At(s)).lower);
}

}  // namespace collision::motion
