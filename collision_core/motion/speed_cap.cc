#include "collision_core/motion/speed_cap.h"

namespace collision {
namespace {

/// Within this part of V of the cap a speed counts as at it: rounding must not decide between now
/// and, with M = 0, never.
constexpr double kAtTheCap = 0x1p-40;

/// The stamp + the time until slope + rate · σ has grown to the limit, where `room` is what it has
/// left: the least instant for which that may be.
Instant TakesOver(const SpaceTimeBound& bound, Interval room, Interval rate) {
  if (room.lower <= kAtTheCap * bound.declaration.speed_max) return bound.state.stamp;
  if (rate.lower <= 0) return Instant::Never();
  const double seconds = (room / rate - bound.skew).lower;
  return AddRoundedDown(bound.state.stamp, std::max(0.0, seconds));
}

Quadratic Growing(Interval u, Interval speed, Instant from, Instant base) {
  return {u + speed * SecondsBetween(from, base), speed, 0};
}

}  // namespace

Interval CappedSpeed(const AgentDeclaration& declaration) {
  return Interval(declaration.speed_max) +
         Interval(0.5) * declaration.acceleration_max * Interval(declaration.time_step);
}

Instant CapTakesOver(const SpaceTimeBound& bound) {
  const Interval room = Interval(bound.declaration.speed_max) -
                        Norm(IntervalVector(bound.state.v_WA)) - bound.state.velocity_error;
  return TakesOver(bound, room, bound.declaration.acceleration_max);
}

Instant FaceCapTakesOver(const SpaceTimeBound& bound, double along, double fraction) {
  const AgentDeclaration& declaration = bound.declaration;
  const Interval rate = Interval(fraction) * declaration.acceleration_max;
  const Interval step_room =
      Interval(0.5) * declaration.time_step * (Interval(declaration.acceleration_max) - rate);
  const Interval room = Interval(declaration.speed_max) - along - bound.state.velocity_error;
  return TakesOver(bound, room + step_room, rate);
}

Quadratic CappedBall::UFrom(Instant base) const { return Growing(u, speed, from, base); }

Quadratic CappedFace::UFrom(Instant base) const { return Growing(u, speed, from, base); }

CappedBall CapBall(const SpaceTimeBound& bound) {
  CappedBall cap;
  cap.from = CapTakesOver(bound);
  if (cap.from.is_never()) return cap;
  cap.shift = SecondsBetween(bound.state.stamp, cap.from) * IntervalVector(bound.state.v_WA);
  cap.u = ForwardBall(bound, cap.from).u0;
  cap.speed = CappedSpeed(bound.declaration);
  return cap;
}

CappedFace CapFace(const SpaceTimeBound& bound, int axis, int sign, Interval fraction) {
  const double along = sign * bound.state.v_WA[axis];
  CappedFace cap;
  cap.from = FaceCapTakesOver(bound, along, fraction.upper);
  if (cap.from.is_never()) return cap;
  cap.shift = SecondsBetween(bound.state.stamp, cap.from) * Interval(along);
  cap.u = ForwardErrors(bound, cap.from).c0 + fraction * ForwardDeviation(bound, cap.from).c0;
  cap.speed = CappedSpeed(bound.declaration);
  return cap;
}

}  // namespace collision
