#include "client/programs/simulators/robots/robot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/shape.h"

namespace collision::client {
namespace {

constexpr std::uint64_t kJointSeed = 0x10b;  // joints and base draw different numbers
constexpr int kTurnSteps[] = {10, 40};       // between two choices of a joint's speed

// The cubic of a step accelerates a little more than the chain.
constexpr double kCubicMore = 1.05;
constexpr double kCubicMoreAbsolute = 0.1;  // [m/s²]

// Turns stay inside α by this factor, for rounding.
constexpr double kTurnInside = 1 - 1e-6;

/// Turns x to the link's direction.
Quaternion AboutZ(double angle) { return {std::cos(angle / 2), 0, 0, std::sin(angle / 2)}; }

MotionPiece CubicBetween(const RigidState& begin, const RigidState& end, std::int64_t t0_ns,
                         std::int64_t t1_ns) {
  const double h = static_cast<double>(t1_ns - t0_ns) * 1e-9;
  MotionPiece piece{t0_ns, t1_ns, {}};
  for (int axis = 0; axis < 3; ++axis) {
    const double v0 = begin.velocity_m_s[axis], v1 = end.velocity_m_s[axis];
    const double mean = (end.position_m[axis] - begin.position_m[axis]) / h;
    piece.coefficients[axis] = {begin.position_m[axis], v0, (3 * mean - 2 * v0 - v1) / h,
                                (v0 + v1 - 2 * mean) / (h * h)};
  }
  return piece;
}

}  // namespace

std::shared_ptr<const Shape> LinkShape(const RobotLimits& limits, std::size_t link) {
  const double half = limits.link_length_m / 2, thin = limits.link_thickness_m / 2;
  const double quarter = std::sqrt(0.5);  // turns z to x
  const Solid solid = link % 2 == 0
                          ? Solid::Box({half + thin, thin, thin})
                          : Solid::Capsule(thin, half).At({0, 0, 0}, {quarter, 0, quarter, 0});
  return Shape::Make({.solids = {solid}});
}

double LinkAccelerationMax(const RobotLimits& limits, std::size_t link) {
  const double speed = limits.turn.angular_speed_max_rad_s;
  const double of_joint =
      limits.link_length_m * std::hypot(limits.turn.angular_acceleration_max_rad_s2, speed * speed);
  const double joints = static_cast<double>(link) + 0.5;
  return kCubicMore * (limits.base.acceleration_max_m_s2 + joints * of_joint) + kCubicMoreAbsolute;
}

Robot::Robot(const RobotLimits& limits, const Vector3& position_m, std::uint64_t seed)
    : limits_(limits),
      random_(seed ^ kJointSeed),
      base_(limits.base, position_m, seed),
      plane_(RandomOrientation(&random_)),
      joints_(limits.links) {
  double angle = random_.Uniform(-std::numbers::pi, std::numbers::pi);
  for (Joint& joint : joints_) joint.angle = angle += random_.Uniform(-1, 1);
  states_ = Chain();
}

/// The angular acceleration of the joint in this step.
double Robot::TurnOf(Joint* joint, double step) {
  const double most = limits_.turn.angular_speed_max_rad_s;
  if (joint->steps_left-- <= 0) {
    joint->steps_left = static_cast<int>(random_.Uniform(kTurnSteps[0], kTurnSteps[1]));
    joint->speed_wanted = random_.Uniform(-most, most);
  }
  const double limit = limits_.turn.angular_acceleration_max_rad_s2 * kTurnInside;
  return std::clamp((joint->speed_wanted - joint->speed) / step, -limit, limit);
}

std::vector<RigidState> Robot::Chain() const {
  std::vector<RigidState> links;
  Vector3 p = base_.position_m(), v = base_.velocity_m_s();
  for (const Joint& joint : joints_) {
    const double half = limits_.link_length_m / 2;
    const double c = std::cos(joint.angle), s = std::sin(joint.angle);
    const Vector3 along = Scaled(Rotated(plane_, {c, s, 0}), half);
    const Vector3 across = Scaled(Rotated(plane_, {-s, c, 0}), half * joint.speed);
    links.push_back({Sum(p, along), Sum(v, across), Product(plane_, AboutZ(joint.angle)),
                     Scaled(Rotated(plane_, {0, 0, 1}), joint.speed)});
    p = Sum(p, Scaled(along, 2));
    v = Sum(v, Scaled(across, 2));
  }
  return links;
}

std::vector<RigidStep> Robot::Step(std::int64_t t0_ns, std::int64_t t1_ns) {
  const double h = static_cast<double>(t1_ns - t0_ns) * 1e-9;
  const Vector3 axis = Rotated(plane_, {0, 0, 1});
  base_.Step(t0_ns, t1_ns);
  std::vector<RigidStep> steps;
  for (std::size_t link = 0; link < joints_.size(); ++link) {
    const double turn = TurnOf(&joints_[link], h);
    joints_[link].angle += h * (joints_[link].speed + turn * h / 2);
    joints_[link].speed += turn * h;
    steps.push_back({{},
                     {t0_ns, t1_ns, states_[link].orientation, states_[link].angular_velocity_rad_s,
                      Scaled(axis, turn)}});
  }
  const std::vector<RigidState> end = Chain();
  for (std::size_t link = 0; link < end.size(); ++link) {
    steps[link].piece = CubicBetween(states_[link], end[link], t0_ns, t1_ns);
  }
  states_ = end;
  return steps;
}

}  // namespace collision::client
