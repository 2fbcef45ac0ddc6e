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

/// The horn's ball from `base` on, as seen from p_WA and less its radius r, rounded to nearest. The
/// centre v τ is off by 3ε. All terms of the reach u are positive: σ is off by 3ε, σ + h by 4ε, a
/// product of both by 9ε, |v| κ by 4ε, and the sums make it 13ε.
numeric::QuickBall Rounded(const motion::SpaceTimeBound& bound, Instant base) {
  const Eigen::Vector3d& v = bound.state.v_WA;
  const double tau = Seconds(bound.state.stamp, base), sigma = tau + bound.skew;
  const double step = bound.limits.time_step, error = bound.state.velocity_error;
  numeric::QuickBall ball;
  for (int axis = 0; axis < 3; ++axis) ball.c[axis] = v[axis] * tau, ball.v[axis] = v[axis];
  ball.s2 = 0.5 * bound.limits.acceleration_max;
  ball.s1 = error + ball.s2 * (2 * sigma + step);
  ball.s0 = bound.state.position_error + error * sigma + ball.s2 * (sigma * (sigma + step));
  if (bound.skew > 0) {
    ball.s0 += bound.skew * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  return ball;
}

/// The error of the reach's terms: the 13ε of each ball, and the sums of five terms.
constexpr double kErrorOfReach = 20 * numeric::kUnitRoundoff;

/// The error of the centre, relative to the sum of the magnitudes of its terms p_B − p_A, v_B τ_B
/// and v_A τ_A: each is off by 3ε at most, and two more sums make it 5ε.
constexpr double kErrorOfDistance = 6 * numeric::kUnitRoundoff;

/// The error of the velocity v_B − v_A: ε, and what summing the magnitudes costs.
constexpr double kErrorOfVelocity = 2 * numeric::kUnitRoundoff;

}  // namespace

numeric::QuickApproach QuickHornPair(const BoundPair& pair) {
  const auto& [a, b, base, margin] = pair;
  CORE_CHECK(a.state.stamp <= base && b.state.stamp <= base, "a forward horn starts at its stamp",
             a.state.stamp.nanoseconds(), b.state.stamp.nanoseconds(), base.nanoseconds());
  const numeric::QuickBall ball_A = Rounded(a, base), ball_B = Rounded(b, base);
  numeric::QuickBall ball = Difference(ball_A, ball_B);
  double magnitude = 0, speed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Positions first: a scene far from the origin loses only what its inputs lost.
    const double between = b.state.p_WA[axis] - a.state.p_WA[axis];
    ball.c[axis] = between + ball.c[axis];
    magnitude += std::abs(between) + (std::abs(ball_B.c[axis]) + std::abs(ball_A.c[axis]));
    speed += std::abs(ball.v[axis]);
  }
  const double radii = (a.limits.radius + b.limits.radius) + margin;
  const double s0 = radii + ball.s0, s1 = ball.s1;
  const double doubt0 = kErrorOfDistance * magnitude + kErrorOfReach * s0;
  const double doubt1 = kErrorOfVelocity * speed + kErrorOfReach * s1;
  ball.s0 = s0 + doubt0;
  ball.s1 = s1 + doubt1;
  ball.s2 *= 1 + kErrorOfReach;
  return {ball, doubt0, doubt1};
}

}  // namespace collision::intersection
