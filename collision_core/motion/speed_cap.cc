#include "collision_core/motion/speed_cap.h"

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

/// A speed within this part of V below the cap counts as at the cap. With M = 0 rounding would
/// otherwise decide whether the cap takes over at once or never.
constexpr double kAtTheCap = 0x1p-40;

/// The earliest instant, after the stamp, at which a slope that grows at `rate` may have used up
/// `room`, the amount by which it is below the limit at σ = 0.
Instant TakesOver(const SpaceTimeBound& bound, numeric::Interval room, numeric::Interval rate) {
  if (room.lower <= kAtTheCap * bound.limits.speed_max) return bound.state.stamp;
  if (rate.lower <= 0) return Instant::Never();
  const double seconds = (room / rate - bound.skew).lower;
  return numeric::AddRoundedDown(bound.state.stamp, std::max(0.0, seconds));
}

numeric::Quadratic Growing(numeric::Interval u, numeric::Interval speed, Instant from,
                           Instant base) {
  return {u + speed * numeric::SecondsBetween(from, base), speed, 0};
}

}  // namespace

numeric::Interval CappedSpeed(const MotionLimits& limits) {
  CORE_CHECK(HasSpeedCap(limits), "a capped speed has a cap");
  return numeric::Interval(limits.speed_max) +
         numeric::Interval(0.5) * limits.acceleration_max * numeric::Interval(limits.time_step);
}

Instant CapStartOf(const SpaceTimeBound& bound) {
  CORE_CHECK(HasSpeedCap(bound.limits), "only a cap takes over");
  const numeric::Interval room = numeric::Interval(bound.limits.speed_max) -
                                 numeric::Norm(numeric::IntervalVector(bound.state.v_WA)) -
                                 bound.state.velocity_error;
  return TakesOver(bound, room, bound.limits.acceleration_max);
}

Instant FaceCapStartOf(const SpaceTimeBound& bound, double along, double fraction) {
  CORE_CHECK(HasSpeedCap(bound.limits), "only a cap takes over", along, fraction);
  const MotionLimits& limits = bound.limits;
  const numeric::Interval rate = numeric::Interval(fraction) * limits.acceleration_max;
  const numeric::Interval step_room = numeric::Interval(0.5) * limits.time_step *
                                      (numeric::Interval(limits.acceleration_max) - rate);
  const numeric::Interval room =
      numeric::Interval(limits.speed_max) - along - bound.state.velocity_error;
  return TakesOver(bound, room + step_room, rate);
}

numeric::Quadratic CappedBall::UFrom(Instant base) const { return Growing(u, speed, from, base); }

numeric::Quadratic CappedFace::UFrom(Instant base) const { return Growing(u, speed, from, base); }

CappedBall CappedBallOf(const SpaceTimeBound& bound) {
  CORE_CHECK(HasSpeedCap(bound.limits), "a capped ball has a cap");
  CappedBall cap;
  cap.from = CapStartOf(bound);
  if (cap.from.is_never()) return cap;
  cap.shift = numeric::SecondsBetween(bound.state.stamp, cap.from) *
              numeric::IntervalVector(bound.state.v_WA);
  cap.u = ForwardBall(bound, cap.from).u.c0;
  cap.speed = CappedSpeed(bound.limits);
  return cap;
}

std::optional<BallFromTime> CappedBallFrom(const SpaceTimeBound& bound, Instant base) {
  if (!HasSpeedCap(bound.limits)) return std::nullopt;
  const CappedBall cap = CappedBallOf(bound);
  if (cap.from.is_never()) return std::nullopt;
  return BallFromTime{numeric::SecondsBetween(base, cap.from).lower,
                      {numeric::IntervalVector(bound.state.p_WA), cap.shift,
                       numeric::IntervalVector(0, 0, 0), bound.limits.radius, cap.UFrom(base)}};
}

CappedFace CappedFaceOf(const SpaceTimeBound& bound, int axis, int sign,
                        numeric::Interval fraction) {
  CORE_CHECK(HasSpeedCap(bound.limits), "a capped face has a cap", axis, sign);
  const double along = sign * bound.state.v_WA[axis];
  CappedFace cap;
  cap.from = FaceCapStartOf(bound, along, fraction.upper);
  if (cap.from.is_never()) return cap;
  cap.shift = numeric::SecondsBetween(bound.state.stamp, cap.from) * numeric::Interval(along);
  cap.u = ForwardErrors(bound, cap.from).c0 + fraction * ForwardDeviation(bound, cap.from).c0;
  cap.speed = CappedSpeed(bound.limits);
  return cap;
}

}  // namespace collision::motion
