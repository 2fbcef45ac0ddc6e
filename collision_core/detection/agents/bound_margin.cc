#include "collision_core/detection/agents/bound_margin.h"

#include "collision_core/numeric/rounding.h"

namespace collision::detection {

BoundMargin::BoundMargin(const motion::SpaceTimeBound& bound) {
  constexpr double kShare = 0x1p-40;
  constexpr double kStampRounding = 4e-9;
  const double speed = bound.state.v_WA.norm();
  const double magnitude = bound.state.p_WA.norm() + speed + bound.limits.radius;
  position_ = kShare * magnitude + kStampRounding * speed;
  const double known = bound.state.a_WA.norm();
  velocity_ = kShare * speed + kStampRounding * (bound.limits.acceleration_max + known);
  if (Bends(bound)) acceleration_ = kShare * known + kStampRounding * bound.limits.jerk_max;
}

// Widen() rounds the sum of error and margin down. The sum of the state before may be too small by
// a unit in its last place, 2^-52 of it; the next sum is never too large. So drift plus that unit,
// taken off the margin, keeps the next widened bound inside the one before; twice the unit covers
// the rounding of the product below. Zero and a margin add up exactly.
bool BoundMargin::Spend(const motion::ContractCheck& check, const motion::SpaceTimeBound& before) {
  constexpr double kSumRounding = 0x1p-51;
  const auto spend = [](double drift, double error, double* left) {
    const double lost = numeric::AddUp(drift, kSumRounding * (error > 0 ? error + *left : 0));
    *left = numeric::AddDown(*left, -lost);
    return *left >= 0;
  };
  const motion::MotionState& state = before.state;
  const bool position = spend(check.position_drift, state.position_error, &position_);
  const bool velocity = spend(check.velocity_drift, state.velocity_error, &velocity_);
  if (acceleration_ == 0 && check.acceleration_drift == 0) return position && velocity;
  return spend(check.acceleration_drift, before.limits.acceleration_max, &acceleration_) &&
         position && velocity;
}

motion::SpaceTimeBound BoundMargin::Widen(const motion::SpaceTimeBound& bound) const {
  motion::SpaceTimeBound wide = bound;
  wide.state.position_error = numeric::AddDown(bound.state.position_error, position_);
  wide.state.velocity_error = numeric::AddDown(bound.state.velocity_error, velocity_);
  wide.limits.acceleration_max = numeric::AddDown(bound.limits.acceleration_max, acceleration_);
  if (bound.state.discontinuity && bound.skew > 0) {
    // The jump may have come earlier by the skew: the bound includes where the agent may have been
    // since then.
    const double acceleration = bound.limits.acceleration_max + bound.state.a_WA.norm() +
                                bound.limits.jerk_max * (bound.skew + bound.limits.time_step);
    const double speed = bound.state.v_WA.norm() + acceleration * bound.skew;
    wide.state.position_error += 2 * speed * bound.skew;
  }
  return wide;
}

}  // namespace collision::detection
