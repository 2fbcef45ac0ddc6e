#include "collision_core/motion/space_time_bound.h"

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

/// σ(δ) = start + slope δ: the time over which errors and accelerations have worked.
struct Elapsed {
  numeric::Interval start;
  double slope;
};

Elapsed ForwardFrom(const SpaceTimeBound& bound, Instant base) {
  CORE_CHECK(base >= bound.state.stamp, "a forward horn starts at its stamp", base.nanoseconds(),
             bound.state.stamp.nanoseconds());
  return {numeric::SecondsBetween(bound.state.stamp, base) + bound.skew, 1};
}

Elapsed BackwardFrom(const SpaceTimeBound& bound, Instant base) {
  CORE_CHECK(base <= bound.state.stamp, "a backward horn ends at its stamp", base.nanoseconds(),
             bound.state.stamp.nanoseconds());
  return {numeric::SecondsBetween(base, bound.state.stamp) + bound.skew, -1};
}

/// ½ D σ (σ + h) + ⅙ J ((σ + h)³ − h³) as a cubic in δ.
numeric::Cubic Deviation(const MotionLimits& limits, Elapsed elapsed) {
  const numeric::Interval half_max = numeric::Interval(0.5) * limits.acceleration_max;
  const numeric::Interval step = limits.time_step, start = elapsed.start, slope = elapsed.slope;
  numeric::Cubic deviation{half_max * start * (start + step),
                           half_max * slope * (numeric::Interval(2) * start + step), half_max};
  if (limits.jerk_max == 0) return deviation;
  const numeric::Interval half_jerk = numeric::Interval(0.5) * limits.jerk_max;
  const numeric::Interval sixth_jerk = numeric::Interval(limits.jerk_max) / 6;
  const numeric::Interval whole = start + step, thrice_step = numeric::Interval(3) * step;
  return deviation + numeric::Cubic{sixth_jerk * start * (Square(start) + thrice_step * whole),
                                    half_jerk * slope * Square(whole), half_jerk * whole,
                                    sixth_jerk * slope};
}

/// ε_p + |v| κ + ε_v σ + |a| (κ + ½ h) σ as a cubic in δ.
numeric::Cubic Errors(const SpaceTimeBound& bound, Elapsed elapsed) {
  const MotionState& state = bound.state;
  const numeric::Interval speed =
      bound.skew > 0 ? numeric::Norm(numeric::IntervalVector(state.v_WA)) : numeric::Interval(0);
  numeric::Interval rate = state.velocity_error;
  if (HasKnownAcceleration(state)) {
    rate = rate + numeric::Norm(numeric::IntervalVector(state.a_WA)) *
                      (bound.skew + numeric::Interval(0.5) * bound.limits.time_step);
  }
  return {state.position_error + speed * bound.skew + rate * elapsed.start, rate * elapsed.slope,
          0};
}

numeric::MovingBall Ball(const SpaceTimeBound& bound, Elapsed elapsed,
                         numeric::Interval since_stamp) {
  const numeric::IntervalVector velocity(bound.state.v_WA);
  numeric::MovingBall ball{numeric::IntervalVector(bound.state.p_WA), since_stamp * velocity,
                           velocity, bound.limits.radius,
                           Errors(bound, elapsed) + Deviation(bound.limits, elapsed)};
  ball.bends = HasKnownAcceleration(bound.state);
  if (!ball.bends) return ball;
  const numeric::IntervalVector acceleration(bound.state.a_WA);
  ball.bend = numeric::Interval(0.5) * acceleration;
  ball.shift = ball.shift + Square(since_stamp) * ball.bend;
  ball.velocity = velocity + since_stamp * acceleration;
  return ball;
}

bool HasDirection(const MotionState& state) { return !state.direction.isZero(0); }

}  // namespace

numeric::MovingBall ForwardBall(const SpaceTimeBound& bound, Instant base) {
  return Ball(bound, ForwardFrom(bound, base), numeric::SecondsBetween(bound.state.stamp, base));
}

numeric::MovingBall BackwardBall(const SpaceTimeBound& bound, Instant base) {
  return Ball(bound, BackwardFrom(bound, base), numeric::SecondsBetween(bound.state.stamp, base));
}

numeric::Cubic ForwardDeviation(const SpaceTimeBound& bound, Instant base) {
  return Deviation(bound.limits, ForwardFrom(bound, base));
}

numeric::Cubic ForwardErrors(const SpaceTimeBound& bound, Instant base) {
  return Errors(bound, ForwardFrom(bound, base));
}

DirectionalReach ReachOfDirection(const MotionState& state) {
  DirectionalReach reach;
  if (!HasDirection(state)) return reach;
  const numeric::Interval length = numeric::Norm(numeric::IntervalVector(state.direction));
  for (int axis = 0; axis < 3; ++axis) {
    const double along = state.direction[axis];
    if (along == 0) continue;
    const double other = state.direction[(axis + 1) % 3], another = state.direction[(axis + 2) % 3];
    const numeric::Interval across = numeric::Min(numeric::Norm({other, another, 0}) / length, 1);
    (along < 0 ? reach.upward : reach.downward)[axis] = across;
  }
  return reach;
}

double DirectionHoldsFor(const SpaceTimeBound& bound, Instant base) {
  if (!HasDirection(bound.state)) return -numeric::kInfinity;
  if (bound.state.direction_until.is_never()) return numeric::kInfinity;
  return (numeric::SecondsBetween(base, bound.state.direction_until) - bound.skew).lower;
}

}  // namespace collision::motion
