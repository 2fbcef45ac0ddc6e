#include "client/programs/simulators/motion/ship.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace collision::client {
namespace {

// The engine stays inside M by this factor, to allow for rounding; see drone.cc.
constexpr double kThrustInside = 1 - 1e-6;

}  // namespace

Vector3 Ship::heading() const {
  const Vector3 d = Rotated(state_.orientation, {1, 0, 0});
  return Scaled(d, 1 / Norm(d));
}

std::int64_t Ship::HeadingHoldsFor() const {
  const double ns = 1e9 * QuarterTurnSeconds(Norm(state_.angular_velocity_rad_s),
                                             limits_.turn.angular_acceleration_max_rad_s2);
  return ns < 1e18 ? static_cast<std::int64_t>(ns) - 1 : std::numeric_limits<std::int64_t>::max();
}

// The share s <= thrust for which |v + s a h| <= V. A ship that is faster, after a bounce, may only
// slow down.
double Ship::ThrustWithinSpeed(double thrust, double step) const {
  const Vector3& v = state_.velocity_m_s;
  const Vector3 gain = Scaled(heading(), limits_.acceleration_max_m_s2 * kThrustInside * step);
  const double a = Dot(gain, gain), b = Dot(v, gain);
  const double cap = std::max(limits_.speed_max_m_s, Norm(v));
  const double c = Dot(v, v) - cap * cap;
  if (!(a > 0)) return 0;
  const double most = (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
  return std::clamp(std::min(thrust, most), 0.0, 1.0);
}

RigidStep Ship::Step(const ShipCommand& command, std::int64_t t0_ns, std::int64_t t1_ns) {
  const double step = static_cast<double>(t1_ns - t0_ns) * 1e-9;
  const double share = ThrustWithinSpeed(command.thrust, step);
  const Vector3 acceleration =
      Scaled(heading(), limits_.acceleration_max_m_s2 * kThrustInside * share);
  RigidStep result;
  result.piece = {t0_ns, t1_ns, {}};
  for (int axis = 0; axis < 3; ++axis) {
    result.piece.coefficients[axis] = {state_.position_m[axis], state_.velocity_m_s[axis],
                                       acceleration[axis] / 2, 0};
  }
  result.turn = TurnTowards(state_, command.turn_rate_rad_s, limits_.turn, t0_ns, t1_ns);
  const PositionAndVelocity end = Evaluate(result.piece, t1_ns);
  state_ = {end.position_m, end.velocity_m_s, OrientationAt(result.turn, t1_ns),
            AngularVelocityAt(result.turn, t1_ns)};
  return result;
}

void Ship::SetVelocities(const Vector3& velocity_m_s, const Vector3& angular_velocity_rad_s) {
  state_.velocity_m_s = velocity_m_s;
  state_.angular_velocity_rad_s =
      AtMost(angular_velocity_rad_s, limits_.turn.angular_speed_max_rad_s);
}

}  // namespace collision::client
