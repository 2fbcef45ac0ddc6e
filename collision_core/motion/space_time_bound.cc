#include "collision_core/motion/space_time_bound.h"

#include "collision_core/base/check.h"
#include "collision_core/motion/speed_cap.h"
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

/// ½ M σ (σ + h) as a quadratic in δ.
numeric::Quadratic Deviation(const MotionLimits& limits, Elapsed elapsed) {
  const numeric::Interval half_max = numeric::Interval(0.5) * limits.acceleration_max;
  const numeric::Interval step = limits.time_step;
  return {half_max * elapsed.start * (elapsed.start + step),
          half_max * elapsed.slope * (numeric::Interval(2) * elapsed.start + step), half_max};
}

/// ε_p + |v| κ + ε_v σ as a quadratic in δ.
numeric::Quadratic Errors(const SpaceTimeBound& bound, Elapsed elapsed) {
  const MotionState& state = bound.state;
  const numeric::Interval speed =
      bound.skew > 0 ? numeric::Norm(numeric::IntervalVector(state.v_WA)) : numeric::Interval(0);
  return {state.position_error + speed * bound.skew +
              numeric::Interval(state.velocity_error) * elapsed.start,
          numeric::Interval(state.velocity_error) * elapsed.slope, 0};
}

numeric::MovingBall Ball(const SpaceTimeBound& bound, Elapsed elapsed,
                         numeric::Interval since_stamp) {
  const numeric::IntervalVector velocity(bound.state.v_WA);
  return {numeric::IntervalVector(bound.state.p_WA), since_stamp * velocity, velocity,
          bound.limits.radius, Errors(bound, elapsed) + Deviation(bound.limits, elapsed)};
}

bool HasDirection(const MotionState& state) { return !state.direction.isZero(0); }

/// How far a capped face has come from p_WA by t, less the radius; `horn_reach` if the cap has not
/// taken over before.
numeric::Interval ReachAt(const CappedFace& face, Instant t, numeric::Interval horn_reach) {
  return face.from < t ? face.shift + face.UFrom(t).c0 : horn_reach;
}

}  // namespace

numeric::MovingBall ForwardBall(const SpaceTimeBound& bound, Instant base) {
  return Ball(bound, ForwardFrom(bound, base), numeric::SecondsBetween(bound.state.stamp, base));
}

numeric::MovingBall BackwardBall(const SpaceTimeBound& bound, Instant base) {
  return Ball(bound, BackwardFrom(bound, base), numeric::SecondsBetween(bound.state.stamp, base));
}

numeric::Quadratic ForwardDeviation(const SpaceTimeBound& bound, Instant base) {
  return Deviation(bound.limits, ForwardFrom(bound, base));
}

numeric::Quadratic ForwardErrors(const SpaceTimeBound& bound, Instant base) {
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

FaceBox BoxAt(const SpaceTimeBound& bound, Instant t) {
  const bool holds = DirectionHoldsFor(bound, t) >= 0;
  return BoxAt(bound, t, holds ? DirectionUse::kCounted : DirectionUse::kIgnored);
}

FaceBox BoxAt(const SpaceTimeBound& bound, Instant t, DirectionUse direction) {
  const Elapsed elapsed = ForwardFrom(bound, t);
  const numeric::Interval since = numeric::SecondsBetween(bound.state.stamp, t);
  const numeric::Interval errors = Errors(bound, elapsed).c0;
  const numeric::Interval deviation = Deviation(bound.limits, elapsed).c0;
  const DirectionalReach reach =
      direction == DirectionUse::kCounted ? ReachOfDirection(bound.state) : DirectionalReach();
  const bool capped = HasSpeedCap(bound.limits);
  const numeric::Interval radius = bound.limits.radius;
  FaceBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const numeric::Interval shift = since * numeric::Interval(bound.state.v_WA[axis]);
    numeric::Interval down = errors + reach.downward[axis] * deviation - shift;
    numeric::Interval up = errors + reach.upward[axis] * deviation + shift;
    if (capped) {
      down = ReachAt(CapFace(bound, axis, -1, reach.downward[axis]), t, down);
      up = ReachAt(CapFace(bound, axis, 1, reach.upward[axis]), t, up);
    }
    box.lower[axis] = numeric::Interval(bound.state.p_WA[axis]) - (radius + down);
    box.upper[axis] = numeric::Interval(bound.state.p_WA[axis]) + (radius + up);
  }
  return box;
}

}  // namespace collision::motion
