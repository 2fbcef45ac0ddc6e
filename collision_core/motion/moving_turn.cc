#include "collision_core/motion/moving_turn.h"

namespace collision {
namespace {

// π, rounded up.
constexpr double kHalfTurn = 0x1.921fb54442d19p+1;

// θ with σ = start + slope δ.
Quadratic OffAngle(const SpaceTimeBound& bound, Interval start, double slope) {
  const double alpha = bound.declaration.angular_acceleration_max;
  if (alpha < 0) return {kHalfTurn, 0, 0};
  const Interval half = Interval(0.5) * alpha;
  const Interval step = bound.declaration.time_step;
  const Interval still =
      bound.skew > 0 ? Norm(IntervalVector(bound.state.w_WB)) * bound.skew : Interval(0);
  return {bound.state.rotation_error + still + half * start * (start + step),
          half * slope * (Interval(2) * start + step), half};
}

}  // namespace

MovingTurn ForwardTurn(const SpaceTimeBound& bound, Instant base) {
  const Interval since = SecondsBetween(bound.state.stamp, base);
  return {bound.state.q_WB, bound.state.w_WB, since, OffAngle(bound, since + bound.skew, 1)};
}

MovingTurn BackwardTurn(const SpaceTimeBound& bound, Instant base) {
  const Interval since = SecondsBetween(bound.state.stamp, base);
  return {bound.state.q_WB, bound.state.w_WB, since, OffAngle(bound, -since + bound.skew, -1)};
}

}  // namespace collision
