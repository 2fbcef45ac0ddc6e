#include "client/programs/simulators/motion/autopilot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace collision::client {
namespace {

constexpr double kSettling = 4;     // [1/s] small angles close this fast
constexpr double kPointed = 0.95;   // cosine of the angle at which the engine starts
constexpr double kPushTime = 0.3;   // [s] in which the last of the missing velocity is gained
constexpr double kCruise = 0.6;     // of the speed cap
constexpr double kTolerance = 0.5;  // [m/s] off the wanted velocity
constexpr double kReached = 4;      // [m]
constexpr double kMargin = 0.2;     // targets keep off the walls by this share of the box
constexpr std::int64_t kPatience = 8'000'000'000;  // [ns] for one target

// Any direction across a unit vector.
Vector3 Across(const Vector3& unit) {
  const Vector3 axis = std::abs(unit[2]) < 0.7 ? Vector3{0, 0, 1} : Vector3{0, 1, 0};
  const Vector3 across = Cross(unit, axis);
  return Scaled(across, 1 / Norm(across));
}

}  // namespace

Vector3 TurnRateTowards(const Ship& ship, const Vector3& direction) {
  const Vector3 heading = ship.heading();
  const Vector3 axis = Cross(heading, direction);
  const double sine = Norm(axis), cosine = Dot(heading, direction);
  const double angle = std::atan2(sine, cosine);
  if (sine < 1e-9 && cosine > 0) return {};
  const Vector3 about = sine < 1e-9 ? Across(heading) : Scaled(axis, 1 / sine);
  // ω² / 2 = (α / 2) angle: half of α stops the turn at the end.
  const TurnLimits& limits = ship.limits().turn;
  const double rate = std::min({std::sqrt(limits.angular_acceleration_max_rad_s2 * angle),
                                kSettling * angle, limits.angular_speed_max_rad_s});
  return Scaled(about, rate);
}

ShipCommand FlyAt(const Ship& ship, const Vector3& velocity_m_s, double tolerance_m_s) {
  const Vector3 lacking = Difference(velocity_m_s, ship.state().velocity_m_s);
  const double size = Norm(lacking);
  if (size <= tolerance_m_s) return {};
  const Vector3 direction = Scaled(lacking, 1 / size);
  ShipCommand command;
  command.turn_rate_rad_s = TurnRateTowards(ship, direction);
  if (Dot(ship.heading(), direction) >= kPointed) {
    command.thrust = std::min(1.0, size / (ship.limits().acceleration_max_m_s2 * kPushTime));
  }
  return command;
}

Autopilot::Autopilot(const Vector3& box_m, std::uint64_t seed) : box_m_(box_m), random_(seed) {
  ChooseTarget(std::numeric_limits<std::int64_t>::min());
}

void Autopilot::ChooseTarget(std::int64_t t0_ns) {
  for (int axis = 0; axis < 3; ++axis) {
    target_m_[axis] = box_m_[axis] * random_.Uniform(kMargin, 1 - kMargin);
  }
  const bool first = t0_ns == std::numeric_limits<std::int64_t>::min();
  target_until_ns_ = first ? t0_ns : t0_ns + kPatience;
}

ShipCommand Autopilot::Command(const Ship& ship, std::int64_t t0_ns) {
  Vector3 way = Difference(target_m_, ship.state().position_m);
  if (target_until_ns_ == std::numeric_limits<std::int64_t>::min()) {
    target_until_ns_ = t0_ns + kPatience;
  } else if (Norm(way) < kReached || t0_ns >= target_until_ns_) {
    ChooseTarget(t0_ns);
    way = Difference(target_m_, ship.state().position_m);
  }
  const double distance = std::max(Norm(way), 1e-3);
  const double speed = kCruise * ship.limits().speed_max_m_s;
  return FlyAt(ship, Scaled(way, speed / distance), kTolerance);
}

}  // namespace collision::client
