#include "collision_core/motion/speed_cap.h"

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

/// A speed within this part of V below the cap counts as at the cap. With M = 0 rounding would
/// otherwise decide whether the cap takes over at once or never.
constexpr double kAtTheCap = 0x1p-40;

/// The earliest instant, after the stamp, at which a slope that grows at `rate`, and at `jerk` ever
/// faster, may have used up `room`, the amount by which it is below the limit at σ = 0. The jerk
/// counts from 2 κ + h earlier on, so that the next state's cap does not take over before this one
/// (speed_cap.h, Nesting): between two states of a kept motion the velocity may have changed by ½ J
/// s (s + 2 (κ + h)), and |a| κ by J s κ.
Instant TakesOver(const SpaceTimeBound& bound, numeric::Interval room, numeric::Interval rate,
                  numeric::Interval jerk) {
  if (jerk.upper > 0) {
    const numeric::Interval earlier =
        numeric::Interval(2) * bound.skew + numeric::Interval(bound.limits.time_step);
    room = room - numeric::Interval(0.5) * jerk * Square(earlier);
    rate = rate + jerk * earlier;
  }
  if (room.lower <= kAtTheCap * bound.limits.speed_max) return bound.state.stamp;
  if (rate.lower <= 0 && jerk.upper == 0) return Instant::Never();
  const numeric::Interval sigma =
      jerk.upper == 0 ? room / rate : numeric::FirstZero(room.lower, rate.upper, 0.5 * jerk.upper);
  const double seconds = (sigma - bound.skew).lower;
  return numeric::AddRoundedDown(bound.state.stamp, std::max(0.0, seconds));
}

numeric::Interval Known(const MotionState& state) {
  return HasKnownAcceleration(state) ? numeric::Norm(numeric::IntervalVector(state.a_WA))
                                     : numeric::Interval(0);
}

numeric::Cubic Growing(numeric::Interval u, numeric::Interval speed, Instant from, Instant base) {
  return {u + speed * numeric::SecondsBetween(from, base), speed, 0};
}

}  // namespace

numeric::Interval CappedSpeed(const SpaceTimeBound& bound) {
  const MotionLimits& limits = bound.limits;
  CORE_CHECK(HasSpeedCap(limits), "a capped speed has a cap");
  if (limits.jerk_max > 0) return (limits.time_step > 0 ? 2 : 1) * limits.speed_max;
  return numeric::Interval(limits.speed_max) + numeric::Interval(0.5) *
                                                   (limits.acceleration_max + Known(bound.state)) *
                                                   numeric::Interval(limits.time_step);
}

Instant CapStartOf(const SpaceTimeBound& bound) {
  CORE_CHECK(HasSpeedCap(bound.limits), "only a cap takes over");
  const numeric::Interval room = numeric::Interval(bound.limits.speed_max) -
                                 numeric::Norm(numeric::IntervalVector(bound.state.v_WA)) -
                                 bound.state.velocity_error;
  return TakesOver(bound, room, bound.limits.acceleration_max + Known(bound.state),
                   bound.limits.jerk_max);
}

Instant FaceCapStartOf(const SpaceTimeBound& bound, FaceNormal face, double fraction) {
  CORE_CHECK(HasSpeedCap(bound.limits), "only a cap takes over", face.axis, fraction);
  const MotionLimits& limits = bound.limits;
  const numeric::Interval rate = numeric::Interval(fraction) * limits.acceleration_max;
  const numeric::Interval step_room = numeric::Interval(0.5) * limits.time_step *
                                      (numeric::Interval(limits.acceleration_max) - rate);
  const numeric::Interval room = numeric::Interval(limits.speed_max) -
                                 face.Along(bound.state.v_WA) - bound.state.velocity_error -
                                 Known(bound.state) * bound.skew;
  return TakesOver(bound, room + step_room, rate + std::max(0.0, face.Along(bound.state.a_WA)),
                   numeric::Interval(fraction) * limits.jerk_max);
}

numeric::Interval PathOfFace(const MotionState& state, FaceNormal face, numeric::Interval since) {
  const numeric::Interval path = since * numeric::Interval(face.Along(state.v_WA));
  const double known = face.Along(state.a_WA);
  if (known == 0) return path;
  return path + Square(since) * (numeric::Interval(0.5) * known);
}

numeric::Cubic CappedBall::UFrom(Instant base) const { return Growing(u, speed, from, base); }

numeric::Cubic CappedFace::UFrom(Instant base) const { return Growing(u, speed, from, base); }

CappedBall CappedBallOf(const SpaceTimeBound& bound) {
  CORE_CHECK(HasSpeedCap(bound.limits), "a capped ball has a cap");
  CappedBall cap;
  cap.from = CapStartOf(bound);
  if (cap.from.is_never()) return cap;
  const numeric::MovingBall ball = ForwardBall(bound, cap.from);
  cap.shift = ball.shift;
  cap.u = ball.u.c0;
  cap.speed = CappedSpeed(bound);
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

CappedFace CappedFaceOf(const SpaceTimeBound& bound, FaceNormal face, numeric::Interval fraction) {
  CORE_CHECK(HasSpeedCap(bound.limits), "a capped face has a cap", face.axis, face.sign);
  CappedFace cap;
  cap.from = FaceCapStartOf(bound, face, fraction.upper);
  if (cap.from.is_never()) return cap;
  cap.shift = PathOfFace(bound.state, face, numeric::SecondsBetween(bound.state.stamp, cap.from));
  cap.u = ForwardErrors(bound, cap.from).c0 + fraction * ForwardDeviation(bound, cap.from).c0;
  cap.speed = CappedSpeed(bound);
  return cap;
}

}  // namespace collision::motion
