#include "collision_core/intersection/quick_horn_pair.h"

#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"
#include "collision_core/numeric/seconds.h"

namespace collision::intersection {
namespace {

// Below, ε is kUnitRoundoff.

/// The seconds from `from` to `to`, off by 2ε relative: from integer to double, and the quotient.
double Seconds(Instant from, Instant to) {
  std::int64_t nanoseconds;
  if (__builtin_sub_overflow(to.nanoseconds(), from.nanoseconds(), &nanoseconds))
    return numeric::kInfinity;
  return static_cast<double>(nanoseconds) / numeric::kNanosecondsPerSecond;
}

/// The horn's ball from `base` on, as seen from p_WA and less its radius r, rounded to nearest, and
/// the magnitudes of what a known acceleration adds to its centre and velocity.
struct RoundedHorn {
  numeric::QuickBall ball;
  double bent = 0, faster = 0;
};

/// What known acceleration and jerk add to a horn. The centre v τ + ½ a τ² is off by 7ε of its
/// terms' magnitudes, the velocity v + a τ by 4ε of them. Of the reach |a| (κ + ½ h) is off by 5ε,
/// with its σ by 9ε; the jerk's terms are off by 14ε at most, and the sums make it 20ε.
void Bend(const motion::SpaceTimeBound& bound, double tau, RoundedHorn* horn) {
  const Eigen::Vector3d& a = bound.state.a_WA;
  const double sigma = tau + bound.skew, step = bound.limits.time_step;
  numeric::QuickBall& ball = horn->ball;
  if (motion::HasKnownAcceleration(bound.state)) {
    for (int axis = 0; axis < 3; ++axis) {
      const double half = 0.5 * a[axis], bent = half * (tau * tau), faster = a[axis] * tau;
      ball.bend[axis] = half;
      ball.c[axis] += bent;
      ball.v[axis] += faster;
      horn->bent += std::abs(bent);
      horn->faster += std::abs(faster);
    }
    const double known = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double rate = known * (bound.skew + 0.5 * step);
    ball.s1 += rate;
    ball.s0 += rate * sigma;
  }
  const double half_jerk = 0.5 * bound.limits.jerk_max, whole = sigma + step;
  ball.s3 = bound.limits.jerk_max / 6;
  ball.s2 += half_jerk * whole;
  ball.s1 += half_jerk * (whole * whole);
  ball.s0 += ball.s3 * (sigma * (sigma * sigma + 3 * step * whole));
}

/// The centre v τ is off by 3ε. All terms of the reach u are positive: σ is off by 3ε, σ + h by
/// 4ε, a product of both by 9ε, |v| κ by 4ε, and the sums make it 13ε.
RoundedHorn Rounded(const motion::SpaceTimeBound& bound, Instant base) {
  const Eigen::Vector3d& v = bound.state.v_WA;
  const double tau = Seconds(bound.state.stamp, base), sigma = tau + bound.skew;
  const double step = bound.limits.time_step, error = bound.state.velocity_error;
  RoundedHorn horn;
  numeric::QuickBall& ball = horn.ball;
  for (int axis = 0; axis < 3; ++axis) ball.c[axis] = v[axis] * tau, ball.v[axis] = v[axis];
  ball.s2 = 0.5 * bound.limits.acceleration_max;
  ball.s1 = error + ball.s2 * (2 * sigma + step);
  ball.s0 = bound.state.position_error + error * sigma + ball.s2 * (sigma * (sigma + step));
  if (bound.skew > 0) {
    ball.s0 += bound.skew * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  if (Bends(bound)) Bend(bound, tau, &horn);
  return horn;
}

/// What rounding costs, relative to the reach's terms, and to the magnitudes of the terms of centre
/// and velocity.
struct RoundingCosts {
  double reach, distance, velocity;
};

/// The reach: the 13ε of each ball, and the sums of five terms. The centre's terms p_B − p_A, v_B
/// τ_B and v_A τ_A are off by 3ε at most, and two more sums make it 5ε. The velocity v_B − v_A is
/// off by ε, and summing the magnitudes costs something.
constexpr RoundingCosts kStraight{20 * numeric::kUnitRoundoff, 6 * numeric::kUnitRoundoff,
                                  2 * numeric::kUnitRoundoff};

/// The same where a horn bends: the 20ε of each, 7ε of the centre's terms and 4ε of the velocity's,
/// and the sums as above.
constexpr RoundingCosts kBent{28 * numeric::kUnitRoundoff, 12 * numeric::kUnitRoundoff,
                              8 * numeric::kUnitRoundoff};

/// The difference of two bends is off by ε.
constexpr double kErrorOfBend = 2 * numeric::kUnitRoundoff;

/// Two sixths of jerks and their sum; what this adds is within the root finder's own allowance.
constexpr double kMoreJerk = 1 + 4 * numeric::kUnitRoundoff;

double SumOfMagnitudes(const double (&v)[3]) {
  return (std::abs(v[0]) + std::abs(v[1])) + std::abs(v[2]);
}

}  // namespace

numeric::QuickApproach QuickHornPair(const BoundPair& pair) {
  const auto& [a, b, base, margin] = pair;
  CORE_CHECK(a.state.stamp <= base && b.state.stamp <= base, "a forward horn starts at its stamp",
             a.state.stamp.nanoseconds(), b.state.stamp.nanoseconds(), base.nanoseconds());
  const RoundedHorn of_A = Rounded(a, base), of_B = Rounded(b, base);
  const numeric::QuickBall &ball_A = of_A.ball, &ball_B = of_B.ball;
  numeric::QuickBall ball = Difference(ball_A, ball_B);
  double magnitude = 0, speed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Positions first: a scene far from the origin loses only what its inputs lost.
    const double between = b.state.p_WA[axis] - a.state.p_WA[axis];
    ball.c[axis] = between + ball.c[axis];
    magnitude += std::abs(between) + (std::abs(ball_B.c[axis]) + std::abs(ball_A.c[axis]));
    speed += std::abs(ball.v[axis]);
  }
  const bool bends = Bends(a) || Bends(b);
  if (bends) {
    // The terms of a sum may be larger than the sum.
    magnitude += 2 * (of_A.bent + of_B.bent);
    speed += (SumOfMagnitudes(ball_A.v) + SumOfMagnitudes(ball_B.v)) + (of_A.faster + of_B.faster);
  }
  const RoundingCosts& costs = bends ? kBent : kStraight;
  const double radii = (a.limits.radius + b.limits.radius) + margin;
  const double s0 = radii + ball.s0, s1 = ball.s1;
  const double doubt0 = costs.distance * magnitude + costs.reach * s0;
  const double doubt1 = costs.velocity * speed + costs.reach * s1;
  ball.s0 = s0 + doubt0;
  ball.s1 = s1 + doubt1;
  if (!bends) {
    ball.s2 *= 1 + costs.reach;
    return {ball, doubt0, doubt1};
  }
  const double doubt2 = kErrorOfBend * SumOfMagnitudes(ball.bend) + costs.reach * ball.s2;
  ball.s2 += doubt2;
  ball.s3 *= kMoreJerk;
  return {ball, doubt0, doubt1, doubt2, true};
}

}  // namespace collision::intersection
