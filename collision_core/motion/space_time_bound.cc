#include "collision_core/motion/space_time_bound.h"

#include "collision_core/motion/speed_cap.h"

namespace collision {
namespace {

/// σ(δ) = start + slope δ: the time over which errors and accelerations have worked.
struct Elapsed {
  Interval start;
  double slope;
};

Elapsed ForwardFrom(const SpaceTimeBound& bound, Instant base) {
  return {SecondsBetween(bound.state.stamp, base) + bound.skew, 1};
}

Elapsed BackwardFrom(const SpaceTimeBound& bound, Instant base) {
  return {SecondsBetween(base, bound.state.stamp) + bound.skew, -1};
}

/// ½ M σ (σ + h) as a quadratic in δ.
Quadratic Deviation(const AgentDeclaration& declaration, Elapsed elapsed) {
  const Interval half_max = Interval(0.5) * declaration.acceleration_max;
  const Interval step = declaration.time_step;
  return {half_max * elapsed.start * (elapsed.start + step),
          half_max * elapsed.slope * (Interval(2) * elapsed.start + step), half_max};
}

/// ε_p + |v| κ + ε_v σ as a quadratic in δ.
Quadratic Errors(const SpaceTimeBound& bound, Elapsed elapsed) {
  const MotionState& state = bound.state;
  const Interval speed = bound.skew > 0 ? Norm(IntervalVector(state.v_WA)) : Interval(0);
  return {
      state.position_error + speed * bound.skew + Interval(state.velocity_error) * elapsed.start,
      Interval(state.velocity_error) * elapsed.slope, 0};
}

MovingBall Ball(const SpaceTimeBound& bound, Elapsed elapsed, Interval since_stamp) {
  const IntervalVector velocity(bound.state.v_WA);
  const Quadratic u = Errors(bound, elapsed) + Deviation(bound.declaration, elapsed);
  return {IntervalVector(bound.state.p_WA) + since_stamp * velocity, velocity, u.c0, u.c1, u.c2};
}

bool HasDirection(const MotionState& state) { return !state.direction.isZero(0); }

/// How far the face with the normal `sign` times the axis has come from p_WA by t, less the radius,
/// if the cap has taken over before; else nothing is changed.
void CapReach(const SpaceTimeBound& bound, int axis, int sign, Interval fraction, Instant t,
              Interval* reach) {
  const CappedFace face = CapFace(bound, axis, sign, fraction);
  if (face.from < t) *reach = face.shift + face.UFrom(t).c0;
}

}  // namespace

MovingBall ForwardBall(const SpaceTimeBound& bound, Instant base) {
  return Ball(bound, ForwardFrom(bound, base), SecondsBetween(bound.state.stamp, base));
}

MovingBall BackwardBall(const SpaceTimeBound& bound, Instant base) {
  return Ball(bound, BackwardFrom(bound, base), SecondsBetween(bound.state.stamp, base));
}

Quadratic ForwardDeviation(const SpaceTimeBound& bound, Instant base) {
  return Deviation(bound.declaration, ForwardFrom(bound, base));
}

Quadratic ForwardErrors(const SpaceTimeBound& bound, Instant base) {
  return Errors(bound, ForwardFrom(bound, base));
}

DirectionalReach ReachOfDirection(const MotionState& state) {
  DirectionalReach reach;
  if (!HasDirection(state)) return reach;
  const Interval length = Norm(IntervalVector(state.direction));
  for (int axis = 0; axis < 3; ++axis) {
    const double along = state.direction[axis];
    if (along == 0) continue;
    const double other = state.direction[(axis + 1) % 3], another = state.direction[(axis + 2) % 3];
    const Interval across = Min(Norm({other, another, 0}) / length, 1);
    (along < 0 ? reach.upward : reach.downward)[axis] = across;
  }
  return reach;
}

double DirectionHoldsFor(const SpaceTimeBound& bound, Instant base) {
  if (!HasDirection(bound.state)) return -kInfinity;
  if (bound.state.direction_until.is_never()) return kInfinity;
  return (SecondsBetween(base, bound.state.direction_until) - bound.skew).lower;
}

FaceBox BoxAt(const SpaceTimeBound& bound, Instant t) {
  return BoxAt(bound, t, DirectionHoldsFor(bound, t) >= 0);
}

FaceBox BoxAt(const SpaceTimeBound& bound, Instant t, bool use_direction) {
  const Elapsed elapsed = ForwardFrom(bound, t);
  const Interval since = SecondsBetween(bound.state.stamp, t);
  const Interval errors = Errors(bound, elapsed).c0;
  const Interval deviation = Deviation(bound.declaration, elapsed).c0;
  const DirectionalReach reach = use_direction ? ReachOfDirection(bound.state) : DirectionalReach();
  const bool capped = HasSpeedCap(bound.declaration);
  const Interval radius = bound.declaration.radius;
  FaceBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval shift = since * Interval(bound.state.v_WA[axis]);
    Interval down = errors + reach.downward[axis] * deviation - shift;
    Interval up = errors + reach.upward[axis] * deviation + shift;
    if (capped) {
      CapReach(bound, axis, -1, reach.downward[axis], t, &down);
      CapReach(bound, axis, 1, reach.upward[axis], t, &up);
    }
    box.lower[axis] = Interval(bound.state.p_WA[axis]) - (radius + down);
    box.upper[axis] = Interval(bound.state.p_WA[axis]) + (radius + up);
  }
  return box;
}

}  // namespace collision
