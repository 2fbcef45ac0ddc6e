#include "collision_core/motion/contract.h"

#include <algorithm>

#include "collision_core/base/check.h"
#include "collision_core/motion/contract_between.h"
#include "collision_core/motion/contract_cap.h"
#include "collision_core/numeric/rotation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

/// Steps a sender's integrator may take between two states; each rounds p twice and v once, by half
/// a unit in the last place. A 1 kHz integrator that publishes once a second takes this many.
constexpr double kStepsBetweenStates = 1000;

constexpr double kRoundingPerStep = 0x1p-52;

/// Two stamps, each rounded to the nearest nanosecond: s is off by at most this [s].
constexpr double kStampRounding = 1e-9;

/// Angle [rad] that a step of an integrator may lose: exp(ω h) is a sine and a cosine, each a unit
/// in the last place off, its product with q four terms a component. That is less than 8 · 2^-53 of
/// the quaternion, and twice as much of the angle.
constexpr double kTurnRoundingPerStep = 0x1p-49;

/// What rounding at an honest sender may add to the deviations of position and velocity (or of
/// orientation and angular velocity), and of the known acceleration.
struct Allowance {
  double position;
  double velocity;
  double acceleration = 0;
};

/// The sums p += v dt + ½ a dt² err by kStepsBetweenStates · ulp of the largest |p| on the way,
/// which the two ends and the path between them bound; v += a dt likewise, and its error works on p
/// for s. A stamp off by kStampRounding moves p by |v|, v by the greatest acceleration and a by J
/// times that.
Allowance RoundingAllowance(const SpaceTimeBound& before, const MotionState& next, double s) {
  const double known = std::max(before.state.a_WA.norm(), next.a_WA.norm());
  const double jerk_max = before.limits.jerk_max;
  const double acceleration_max = before.limits.acceleration_max + known + jerk_max * s;
  const double speed = std::max(before.state.v_WA.norm(), next.v_WA.norm()) + acceleration_max * s;
  const double range = std::max(before.state.p_WA.norm(), next.p_WA.norm()) + speed * s;
  constexpr double kRounding = kStepsBetweenStates * kRoundingPerStep;
  const double velocity = kRounding * speed + kStampRounding * acceleration_max;
  return {kRounding * range + velocity * s + kStampRounding * speed, velocity,
          kRounding * known + kStampRounding * jerk_max};
}

/// The deviations from the motion that was known, and how far each may go.
struct Deviations {
  numeric::IntervalVector position, velocity, acceleration;
  numeric::Interval position_length, velocity_length, acceleration_length;
};

Deviations DeviationsOf(const SpaceTimeBound& before, const MotionState& next,
                        numeric::Interval s) {
  Deviations e;
  const numeric::IntervalVector v(before.state.v_WA);
  e.position =
      numeric::IntervalVector(next.p_WA) - numeric::IntervalVector(before.state.p_WA) - s * v;
  e.velocity = numeric::IntervalVector(next.v_WA) - v;
  if (HasKnownAcceleration(before.state)) {
    const numeric::IntervalVector a(before.state.a_WA);
    e.position = e.position - (numeric::Interval(0.5) * Square(s)) * a;
    e.velocity = e.velocity - s * a;
  }
  e.acceleration = numeric::IntervalVector(next.a_WA) - numeric::IntervalVector(before.state.a_WA);
  e.position_length = numeric::Norm(e.position);
  e.velocity_length = numeric::Norm(e.velocity);
  e.acceleration_length = numeric::Norm(e.acceleration);
  return e;
}

/// Of position, velocity and known acceleration; of a rotation the first two.
struct Limits {
  numeric::Interval position, velocity, acceleration;
};

/// ½ D σ (σ + d) + ⅙ J σ (σ² + 3 m σ + 3 m²), D σ + ½ J σ (σ + 2 m) and J σ: what the unknown part
/// of the acceleration does in σ. Given σ + d; of a motion d = m = h, of what two horns do not
/// share d = 2 κ + h and m = κ + h.
Limits OfUnknownPart(const MotionLimits& limits, numeric::Interval sigma,
                     numeric::Interval lengthened, numeric::Interval m) {
  const numeric::Interval acceleration_max = limits.acceleration_max;
  Limits unknown{numeric::Interval(0.5) * acceleration_max * sigma * lengthened,
                 acceleration_max * sigma, 0};
  if (limits.jerk_max == 0) return unknown;
  const numeric::Interval jerk = limits.jerk_max, three_m = numeric::Interval(3) * m;
  unknown.position = unknown.position + jerk / 6 * sigma * (Square(sigma) + three_m * (sigma + m));
  unknown.velocity =
      unknown.velocity + numeric::Interval(0.5) * jerk * sigma * (sigma + numeric::Interval(2) * m);
  unknown.acceleration = jerk * sigma;
  return unknown;
}

numeric::Interval Known(const MotionState& state) {
  return HasKnownAcceleration(state) ? numeric::Norm(numeric::IntervalVector(state.a_WA))
                                     : numeric::Interval(0);
}

/// The farthest that a true motion can deviate. Both stamps may be off by κ, in opposite ways; both
/// states have errors.
Limits LimitsOfMotion(const SpaceTimeBound& before, const MotionState& next, numeric::Interval s) {
  const MotionState& old = before.state;
  const numeric::Interval skew = numeric::Interval(2) * before.skew;
  const numeric::Interval sigma = s + skew, step = before.limits.time_step;
  const Limits unknown = OfUnknownPart(before.limits, sigma, sigma + step, step);
  Limits limits{numeric::Interval(old.position_error) + next.position_error +
                    numeric::Norm(numeric::IntervalVector(old.v_WA)) * skew +
                    numeric::Interval(old.velocity_error) * sigma + unknown.position,
                numeric::Interval(old.velocity_error) + next.velocity_error + unknown.velocity,
                numeric::Interval(2) * before.limits.acceleration_max +
                    numeric::Interval(before.limits.jerk_max) * (sigma + step)};
  if (HasKnownAcceleration(old)) {
    const numeric::Interval known = Known(old);
    limits.position = limits.position + known * (skew + numeric::Interval(0.5) * step) * sigma;
    limits.velocity = limits.velocity + known * skew;
  }
  return limits;
}

/// Within these the new horn lies inside the old one: u'(0) + |e_p| <= u(s) and the slopes
/// likewise, written out so that what both sides share cancels (contract.h).
Limits LimitsOfHorn(const SpaceTimeBound& before, const MotionState& next, numeric::Interval s) {
  const MotionState& old = before.state;
  const numeric::Interval skew = before.skew, step = before.limits.time_step;
  const numeric::Interval less_speed = numeric::Norm(numeric::IntervalVector(old.v_WA)) -
                                       numeric::Norm(numeric::IntervalVector(next.v_WA));
  const numeric::Interval less_velocity_error =
      numeric::Interval(old.velocity_error) - next.velocity_error;
  const Limits unknown = OfUnknownPart(before.limits, s, s + numeric::Interval(2) * skew + step,
                                       numeric::Interval(skew) + step);
  Limits limits{numeric::Interval(old.position_error) - next.position_error + less_speed * skew +
                    numeric::Interval(old.velocity_error) * s + less_velocity_error * skew +
                    unknown.position,
                less_velocity_error + unknown.velocity, unknown.acceleration};
  if (HasKnownAcceleration(old) || HasKnownAcceleration(next)) {
    const numeric::Interval rate = numeric::Interval(skew) + numeric::Interval(0.5) * step;
    const numeric::Interval less_known = Known(old) - Known(next);
    limits.position = limits.position + rate * (Known(old) * s + less_known * skew);
    limits.velocity = limits.velocity + rate * less_known;
  }
  return limits;
}

/// How far the deviation points against a direction that held all the way, at least and at most.
struct Against {
  numeric::Interval position = 0, velocity = 0, acceleration = 0;
};

Against AgainstDirection(const SpaceTimeBound& before, const MotionState& next,
                         const Deviations& deviations) {
  if (DirectionHoldsFor(before, next.stamp) < 0) return {};
  const numeric::IntervalVector d(before.state.direction);
  const numeric::Interval length = numeric::Norm(d);
  const auto against = [&](const numeric::IntervalVector& e) {
    return numeric::Max(0, -Dot(e, d) / length);
  };
  return {against(deviations.position), against(deviations.velocity),
          against(deviations.acceleration)};
}

/// The old direction made the boxes smaller beyond next.stamp, and the new one does not do so as
/// long.
bool LosesDirection(const SpaceTimeBound& before, const MotionState& next) {
  const MotionState& old = before.state;
  if (!CanDeviate(before.limits)) return false;
  if (!(DirectionHoldsFor(before, next.stamp) > 0)) return false;
  return next.direction != old.direction || next.direction_until < old.direction_until;
}

/// `length` certainly exceeds `limit` by this much; 0 if by less than rounding may have cost.
double Excess(numeric::Interval length, numeric::Interval limit, double allowed) {
  const double least = (length - limit).lower;
  return least > allowed ? least : 0;
}

/// Fills the excesses and drifts of position and velocity. False if the drifts exceed what rounding
/// explains.
bool CheckTranslation(const SpaceTimeBound& before, const MotionState& next, numeric::Interval s,
                      ContractCheck* check) {
  const Allowance allowance = RoundingAllowance(before, next, s.upper);
  const Deviations deviations = DeviationsOf(before, next, s);
  const Against against = AgainstDirection(before, next, deviations);

  // Errors and skew may explain a deviation against the direction, acceleration may not.
  const Limits motion = LimitsOfMotion(before, next, s);
  SpaceTimeBound evenly = before;
  evenly.limits.acceleration_max = evenly.limits.jerk_max = 0;
  const Limits errors = LimitsOfMotion(evenly, next, s);
  check->position_excess =
      std::max(Excess(deviations.position_length, motion.position, allowance.position),
               Excess(against.position, errors.position, allowance.position));
  check->velocity_excess =
      std::max(Excess(deviations.velocity_length, motion.velocity, allowance.velocity),
               Excess(against.velocity, errors.velocity, allowance.velocity));
  check->acceleration_excess =
      Excess(deviations.acceleration_length, motion.acceleration, allowance.acceleration);

  // Rounding may have moved the new state, and so the centre that it is traced back to.
  const double gap = GapBetween(before, next);
  if (gap > allowance.position + allowance.velocity * s.upper) check->between_excess = gap;

  const Limits horn = LimitsOfHorn(before, next, s);
  check->position_drift =
      (numeric::Max(0, deviations.position_length - horn.position) + against.position).upper;
  check->velocity_drift =
      (numeric::Max(0, deviations.velocity_length - horn.velocity) + against.velocity).upper;
  check->acceleration_drift =
      (numeric::Max(0, deviations.acceleration_length - horn.acceleration) + against.acceleration)
          .upper;
  if (HasSpeedCap(before.limits)) {
    const CapCheck cap = CheckCap(before, next);
    const auto exceed = [](double excess, double allowed, double* of) {
      if (excess > allowed) *of = std::max(*of, excess);
    };
    exceed(cap.position_excess, allowance.position, &check->position_excess);
    exceed(cap.velocity_excess, allowance.velocity, &check->velocity_excess);
    check->position_drift = std::max(check->position_drift, cap.position_drift);
  }
  return check->position_drift <= 2 * allowance.position &&
         check->velocity_drift <= 2 * allowance.velocity &&
         check->acceleration_drift <= 2 * allowance.acceleration;
}

// Rotation. Let Φ(R, S) be the angle of R Sᵀ, a metric on rotations that no rotation applied to
// both, from either side, changes. R turns at ω(t), the prediction S at the constant ω, both in W.
// In a short dt, by the triangle inequality through exp(ω dt) R, to first order
//   Φ(exp(ω(t) dt) R, exp(ω dt) S) <= Φ(exp(ω(t) dt), exp(ω dt)) + Φ(R, S)
//                                   = |ω(t) − ω| dt + Φ(R, S):
// Φ grows at most at the rate |ω(t) − ω| <= α τ, so Φ <= ½ α τ². An integrator of step h turns by
// exp(ω_k h) with ω_k = ω_{k−1} + a_k h, |a_k| <= α: step k adds at most α k h · h, and after n
// steps Φ <= ½ α h² n (n + 1) = ½ α τ (τ + h). An error of the orientation at the start stays what
// it is; stamps off by κ each, in opposite ways, add |ω| 2κ and make τ up to s + 2κ.

/// The farthest that a true motion can turn: of the orientation, then of the angular velocity.
Limits LimitsOfTurning(const SpaceTimeBound& before, const MotionState& next, numeric::Interval s) {
  const numeric::Interval skew = numeric::Interval(2) * before.skew, sigma = s + skew;
  const numeric::Interval acceleration_max = before.limits.angular_acceleration_max;
  return {numeric::Interval(before.state.rotation_error) + next.rotation_error +
              numeric::Norm(numeric::IntervalVector(before.state.w_WB)) * skew +
              numeric::Interval(0.5) * acceleration_max * sigma * (sigma + before.limits.time_step),
          acceleration_max * sigma, 0};
}

/// Within these the new bound on the orientation lies inside the old one, as LimitsOfHorn().
Limits LimitsOfTurningHorn(const SpaceTimeBound& before, const MotionState& next,
                           numeric::Interval s) {
  const MotionState& old = before.state;
  const numeric::Interval skew = before.skew;
  const numeric::Interval acceleration_max = before.limits.angular_acceleration_max;
  const numeric::Interval less_speed = numeric::Norm(numeric::IntervalVector(old.w_WB)) -
                                       numeric::Norm(numeric::IntervalVector(next.w_WB));
  return {numeric::Interval(old.rotation_error) - next.rotation_error + less_speed * skew +
              numeric::Interval(0.5) * acceleration_max * s *
                  (s + numeric::Interval(2) * skew + before.limits.time_step),
          acceleration_max * s, 0};
}

/// As RoundingAllowance(), of orientation and angular velocity.
Allowance TurnRoundingAllowance(const SpaceTimeBound& before, const MotionState& next, double s) {
  const double acceleration_max = before.limits.angular_acceleration_max;
  const double speed = std::max(before.state.w_WB.norm(), next.w_WB.norm()) + acceleration_max * s;
  const double velocity =
      kStepsBetweenStates * kRoundingPerStep * speed + kStampRounding * acceleration_max;
  return {kStepsBetweenStates * kTurnRoundingPerStep + velocity * s + kStampRounding * speed,
          velocity};
}

/// As CheckTranslation(), of orientation and angular velocity.
bool CheckRotation(const SpaceTimeBound& before, const MotionState& next, numeric::Interval s,
                   ContractCheck* check) {
  const MotionState& old = before.state;
  const numeric::Interval angle =
      AngleBetween(Turned(old.q_WB, old.w_WB, s), numeric::UnitQuaternion(next.q_WB));
  const numeric::Interval change =
      numeric::Norm(numeric::IntervalVector(next.w_WB) - numeric::IntervalVector(old.w_WB));
  const Allowance allowance = TurnRoundingAllowance(before, next, s.upper);
  const Limits motion = LimitsOfTurning(before, next, s);
  check->rotation_excess = Excess(angle, motion.position, allowance.position);
  check->angular_velocity_excess = Excess(change, motion.velocity, allowance.velocity);
  const Limits horn = LimitsOfTurningHorn(before, next, s);
  check->rotation_drift = numeric::Max(0, angle - horn.position).upper;
  check->angular_velocity_drift = numeric::Max(0, change - horn.velocity).upper;
  return check->rotation_drift <= 2 * allowance.position &&
         check->angular_velocity_drift <= 2 * allowance.velocity;
}

}  // namespace

ContractCheck CheckContract(const SpaceTimeBound& before, const MotionState& next,
                            OrientationUse orientation) {
  CORE_CHECK(next.stamp >= before.state.stamp, "a state follows the one before",
             next.stamp.nanoseconds(), before.state.stamp.nanoseconds());
  const numeric::Interval s = numeric::SecondsBetween(before.state.stamp, next.stamp);
  ContractCheck check;
  bool is_inside = CheckTranslation(before, next, s, &check);
  if (orientation == OrientationUse::kMatters && before.limits.angular_acceleration_max >= 0) {
    is_inside = CheckRotation(before, next, s, &check) && is_inside;
  }
  if (check.position_excess > 0 || check.velocity_excess > 0 || check.acceleration_excess > 0 ||
      check.rotation_excess > 0 || check.angular_velocity_excess > 0 || check.between_excess > 0) {
    check.verdict = ContractVerdict::kBreached;
  } else if (!is_inside || next.expiry > before.state.expiry || LosesDirection(before, next)) {
    check.verdict = ContractVerdict::kWidened;
  }
  if (check.verdict != ContractVerdict::kKept) {
    check.position_drift = check.velocity_drift = check.acceleration_drift = 0;
    check.rotation_drift = check.angular_velocity_drift = 0;
  }
  return check;
}

}  // namespace collision::motion
