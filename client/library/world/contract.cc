#include "client/library/world/contract.h"

#include <algorithm>
#include <cmath>

#include "client/library/vector.h"
#include "collision_core/motion/contract_between.h"

namespace collision::client {
namespace {

/// Half of what the service allows for rounding: a thousand integration steps between two states,
/// half a unit in the last place each.
constexpr double kRounding = 1000 * 0x1p-53;

/// Likewise for an angle: a step of an integrator of orientations loses more.
constexpr double kTurnRounding = 1000 * 0x1p-50;

/// Stamps are whole nanoseconds, and the service allows an error of one; half of it [s].
constexpr double kStampRounding = 0.5e-9;

/// The orientation after `s` seconds at a constant rate in W.
Quaternion Turned(const Quaternion& q, const Vector3& w, double s) {
  const double rate = Norm(w);
  const double half = rate * s / 2;
  const double scale = rate > 0 ? std::sin(half) / rate : 0;
  return Product({std::cos(half), w[0] * scale, w[1] * scale, w[2] * scale}, q);
}

/// Also of quaternions of nearly unit length.
double AngleBetween(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = Product(a, {b[0], -b[1], -b[2], -b[3]});
  return 2 * std::atan2(Norm({d[1], d[2], d[3]}), std::fabs(d[0]));
}

/// How far two states may be apart: by rounding that is not the sender's fault, and in all.
struct Room {
  double position_rounding;
  double velocity_rounding;
  double position;
  double velocity;
};

/// `range`: the greatest coordinate on the way. NaN passes through; the callers' comparisons refuse
/// it.
Room RoomFor(double acceleration_max, double time_step, double speed, double range, double s) {
  Room room;
  room.velocity_rounding = kRounding * speed + kStampRounding * acceleration_max;
  room.position_rounding = kRounding * range + room.velocity_rounding * s + kStampRounding * speed;
  room.velocity = acceleration_max * s + room.velocity_rounding;
  room.position = 0.5 * acceleration_max * s * (s + time_step) + room.position_rounding;
  return room;
}

bool SameDeclaration(const State& sent, const State& next) {
  return !next.discontinuity && next.position_error_m <= sent.position_error_m &&
         next.velocity_error_m_s <= sent.velocity_error_m_s &&
         next.rotation_error_rad <= sent.rotation_error_rad &&
         next.thrust_direction == sent.thrust_direction &&
         next.direction_until_ns == sent.direction_until_ns && next.expiry_ns == sent.expiry_ns;
}

/// The part of a state that decides about its path.
motion::MotionState ToCore(const State& state) {
  motion::MotionState core;
  core.stamp = Instant::FromNanoseconds(state.stamp_ns);
  core.p_WA = Eigen::Map<const Eigen::Vector3d>(state.position_m.data());
  core.v_WA = Eigen::Map<const Eigen::Vector3d>(state.velocity_m_s.data());
  core.a_WA = Eigen::Map<const Eigen::Vector3d>(state.acceleration_m_s2.data());
  core.position_error = state.position_error_m;
  core.velocity_error = state.velocity_error_m_s;
  return core;
}

motion::SpaceTimeBound ToCore(const MotionBounds& bounds, const State& state) {
  motion::SpaceTimeBound core;
  core.state = ToCore(state);
  core.limits.acceleration_max = bounds.acceleration_max_m_s2;
  core.limits.jerk_max = bounds.jerk_max_m_s3;
  core.limits.time_step = bounds.time_step_s;
  return core;
}

bool PathMayFollow(const MotionBounds& bounds, const State& before, const State& next, double s) {
  const double speed_before = Norm(before.velocity_m_s), speed_next = Norm(next.velocity_m_s);
  const double speed = std::max(speed_before, speed_next);
  const double range = std::max(Norm(before.position_m), Norm(next.position_m)) + speed * s;
  const double jerk = bounds.jerk_max_m_s3;
  Room room = RoomFor(bounds.acceleration_max_m_s2, bounds.time_step_s, speed, range, s);
  room.position += jerk * s * s * s / 6;
  room.velocity += 0.5 * jerk * s * s;
  const double velocity_error = before.velocity_error_m_s + next.velocity_error_m_s;
  const double position_error =
      before.position_error_m + next.position_error_m + before.velocity_error_m_s * s;
  Vector3 moved = Difference(next.position_m, before.position_m);
  Vector3 sped = Difference(next.velocity_m_s, before.velocity_m_s);
  for (int axis = 0; axis < 3; ++axis) {
    const double gained = before.acceleration_m_s2[axis] * s;
    moved[axis] -= (before.velocity_m_s[axis] + 0.5 * gained) * s;
    sped[axis] -= gained;
  }
  const Vector3 changed = Difference(next.acceleration_m_s2, before.acceleration_m_s2);
  if (!(Norm(changed) <=
        2 * bounds.acceleration_max_m_s2 + jerk * s + kRounding * Norm(next.acceleration_m_s2))) {
    return false;
  }
  if (!(Norm(moved) <= room.position + position_error)) return false;
  if (!(Norm(sped) <= room.velocity + velocity_error)) return false;
  if (bounds.speed_max_m_s &&
      !(speed_next <= *bounds.speed_max_m_s + kRounding * speed + next.velocity_error_m_s)) {
    return false;
  }
  // Half of what the service allows, as above; the service also allows for clocks that differ.
  if (!(GapBetween(ToCore(bounds, before), ToCore(next)) <=
        room.position_rounding + room.velocity_rounding * s)) {
    return false;
  }
  if (!before.thrust_direction || before.direction_until_ns < next.stamp_ns) return true;
  const Vector3& direction = *before.thrust_direction;
  return -Dot(moved, direction) <= position_error + room.position_rounding &&
         -Dot(sped, direction) <= velocity_error + room.velocity_rounding;
}

bool TurnMayFollow(const MotionBounds& bounds, const State& before, const State& next, double s) {
  if (!bounds.turns || !bounds.angular_acceleration_max_rad_s2) return true;
  const double alpha = *bounds.angular_acceleration_max_rad_s2;
  const double rate =
      std::max(Norm(before.angular_velocity_rad_s), Norm(next.angular_velocity_rad_s));
  const Room room = RoomFor(alpha, bounds.time_step_s, rate, 0, s);
  const double angle =
      AngleBetween(Turned(before.orientation, before.angular_velocity_rad_s, s), next.orientation);
  const double change =
      Norm(Difference(next.angular_velocity_rad_s, before.angular_velocity_rad_s));
  return angle <=
             room.position + kTurnRounding + before.rotation_error_rad + next.rotation_error_rad &&
         change <= room.velocity;
}

}  // namespace

MotionBounds BoundsOf(const AgentDescription& description) {
  return {.acceleration_max_m_s2 = description.acceleration_max_m_s2.value_or(0),
          .jerk_max_m_s3 = description.jerk_max_m_s3,
          .angular_acceleration_max_rad_s2 = description.angular_acceleration_max_rad_s2,
          .speed_max_m_s = description.speed_max_m_s,
          .time_step_s = description.time_step_s.value_or(0),
          .turns = description.shape != nullptr};
}

MotionBounds Wider(const MotionBounds& a, const MotionBounds& b) {
  // Either leaves it undeclared, or both have one.
  const auto wider = [](const std::optional<double>& x, const std::optional<double>& y) {
    return x && y ? std::optional(std::max(*x, *y)) : std::nullopt;
  };
  return {.acceleration_max_m_s2 = std::max(a.acceleration_max_m_s2, b.acceleration_max_m_s2),
          .jerk_max_m_s3 = std::max(a.jerk_max_m_s3, b.jerk_max_m_s3),
          .angular_acceleration_max_rad_s2 =
              wider(a.angular_acceleration_max_rad_s2, b.angular_acceleration_max_rad_s2),
          .speed_max_m_s = wider(a.speed_max_m_s, b.speed_max_m_s),
          .time_step_s = std::max(a.time_step_s, b.time_step_s),
          .turns = a.turns && b.turns};
}

bool MayFollow(const MotionBounds& bounds, const State& before, const State& next) {
  if (next.stamp_ns < before.stamp_ns) return false;
  // The difference of two stamps fits only in an unsigned number.
  const auto ns =
      static_cast<std::uint64_t>(next.stamp_ns) - static_cast<std::uint64_t>(before.stamp_ns);
  const double s = static_cast<double>(ns) * 1e-9;
  return PathMayFollow(bounds, before, next, s) && TurnMayFollow(bounds, before, next, s);
}

bool StandsIn(const MotionBounds& bounds, const State& sent, const State& next) {
  return SameDeclaration(sent, next) && MayFollow(bounds, sent, next);
}

}  // namespace collision::client
