#include "collision_core/motion/contract.h"

#include <algorithm>

namespace collision {
namespace {

/// Steps a sender's integrator may take between two states; each rounds p twice and v once, by half
/// a unit in the last place. A 1 kHz integrator that publishes once a second takes this many.
constexpr double kStepsBetweenStates = 1000;

constexpr double kRoundingPerStep = 0x1p-52;

/// Two stamps, each rounded to the nearest nanosecond: s is off by at most this [s].
constexpr double kStampRounding = 1e-9;

/// What rounding at an honest sender may add to the deviations of position and velocity.
struct Allowance {
  double position;
  double velocity;
};

/// The sums p += v dt + ½ a dt² err by kStepsBetweenStates · ulp of the largest |p| on the way,
/// which the two ends and the path between them bound; v += a dt likewise, and its error works on p
/// for s. A stamp off by kStampRounding moves p by |v| and v by M times that.
Allowance RoundingAllowance(const SpaceTimeBound& before, const MotionState& next, double s) {
  const double acceleration_max = before.declaration.acceleration_max;
  const double speed = std::max(before.state.v_WA.norm(), next.v_WA.norm()) + acceleration_max * s;
  const double range = std::max(before.state.p_WA.norm(), next.p_WA.norm()) + speed * s;
  constexpr double kRounding = kStepsBetweenStates * kRoundingPerStep;
  const double velocity = kRounding * speed + kStampRounding * acceleration_max;
  return {kRounding * range + velocity * s + kStampRounding * speed, velocity};
}

/// The deviations from uniform motion, and how far each may go.
struct Deviations {
  IntervalVector position, velocity;
  Interval position_length, velocity_length;
};

Deviations DeviationsOf(const SpaceTimeBound& before, const MotionState& next, Interval s) {
  Deviations e;
  const IntervalVector v(before.state.v_WA);
  e.position = IntervalVector(next.p_WA) - IntervalVector(before.state.p_WA) - s * v;
  e.velocity = IntervalVector(next.v_WA) - v;
  e.position_length = Norm(e.position);
  e.velocity_length = Norm(e.velocity);
  return e;
}

struct Limits {
  Interval position, velocity;
};

/// No true motion goes further. Both stamps may be off by κ, in opposite ways; both states err.
Limits LimitsOfMotion(const SpaceTimeBound& before, const MotionState& next, Interval s) {
  const MotionState& old = before.state;
  const Interval skew = Interval(2) * before.skew;
  const Interval sigma = s + skew;
  const Interval acceleration_max = before.declaration.acceleration_max;
  return {Interval(old.position_error) + next.position_error +
              Norm(IntervalVector(old.v_WA)) * skew + Interval(old.velocity_error) * sigma +
              Interval(0.5) * acceleration_max * sigma * (sigma + before.declaration.time_step),
          Interval(old.velocity_error) + next.velocity_error + acceleration_max * sigma};
}

/// Within these the new horn lies inside the old one: u'(0) + |e_p| <= u(s) and the slopes
/// likewise, written out so that what both sides share cancels (README.md beside this file).
Limits LimitsOfHorn(const SpaceTimeBound& before, const MotionState& next, Interval s) {
  const MotionState& old = before.state;
  const Interval skew = before.skew;
  const Interval acceleration_max = before.declaration.acceleration_max;
  const Interval less_speed = Norm(IntervalVector(old.v_WA)) - Norm(IntervalVector(next.v_WA));
  const Interval less_velocity_error = Interval(old.velocity_error) - next.velocity_error;
  return {Interval(old.position_error) - next.position_error + less_speed * skew +
              Interval(old.velocity_error) * s + less_velocity_error * skew +
              Interval(0.5) * acceleration_max * s *
                  (s + Interval(2) * skew + before.declaration.time_step),
          less_velocity_error + acceleration_max * s};
}

/// How far the deviation points against a direction that held all the way, at least and at most.
struct Against {
  Interval position = 0, velocity = 0;
};

Against AgainstDirection(const SpaceTimeBound& before, const MotionState& next,
                         const Deviations& deviations) {
  if (DirectionHoldsFor(before, next.stamp) < 0) return {};
  const IntervalVector d(before.state.direction);
  const Interval length = Norm(d);
  return {Max(0, -Dot(deviations.position, d) / length),
          Max(0, -Dot(deviations.velocity, d) / length)};
}

/// The old direction made the boxes smaller beyond next.stamp, and the new one does not do so as
/// long.
bool LosesDirection(const SpaceTimeBound& before, const MotionState& next) {
  const MotionState& old = before.state;
  if (before.declaration.acceleration_max == 0) return false;
  if (!(DirectionHoldsFor(before, next.stamp) > 0)) return false;
  return next.direction != old.direction || next.direction_until < old.direction_until;
}

}  // namespace

ContractCheck CheckContract(const SpaceTimeBound& before, const MotionState& next) {
  const Interval s = SecondsBetween(before.state.stamp, next.stamp);
  const Allowance allowance = RoundingAllowance(before, next, s.upper);
  const Deviations deviations = DeviationsOf(before, next, s);
  const Against against = AgainstDirection(before, next, deviations);
  ContractCheck check;

  // Errors and skew may explain a deviation against the direction, acceleration may not.
  const Limits motion = LimitsOfMotion(before, next, s);
  SpaceTimeBound at_rest = before;
  at_rest.declaration.acceleration_max = 0;
  const Limits errors = LimitsOfMotion(at_rest, next, s);
  const auto excess = [](Interval length, Interval limit, double allowed) {
    const double least = (length - limit).lower;
    return least > allowed ? least : 0;
  };
  check.position_excess =
      std::max(excess(deviations.position_length, motion.position, allowance.position),
               excess(against.position, errors.position, allowance.position));
  check.velocity_excess =
      std::max(excess(deviations.velocity_length, motion.velocity, allowance.velocity),
               excess(against.velocity, errors.velocity, allowance.velocity));
  if (check.position_excess > 0 || check.velocity_excess > 0) {
    check.verdict = ContractVerdict::kBreached;
    return check;
  }

  const Limits horn = LimitsOfHorn(before, next, s);
  const double position_drift =
      (Max(0, deviations.position_length - horn.position) + against.position).upper;
  const double velocity_drift =
      (Max(0, deviations.velocity_length - horn.velocity) + against.velocity).upper;
  if (position_drift > 2 * allowance.position || velocity_drift > 2 * allowance.velocity ||
      next.expiry > before.state.expiry || LosesDirection(before, next)) {
    check.verdict = ContractVerdict::kWidened;
    return check;
  }
  check.position_drift = position_drift;
  check.velocity_drift = velocity_drift;
  return check;
}

}  // namespace collision
