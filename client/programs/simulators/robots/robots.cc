#include "client/programs/simulators/robots/robots.h"

#include "collision/shape.h"

namespace collision::client {
namespace {

constexpr std::size_t kMeetAtOne = 8;  // robots per place where they meet

}  // namespace

std::vector<Vector3> RobotPositions(const RobotOptions& options) {
  DroneLimits limits = options.limits.base;
  limits.radius_m = options.limits.reach_m() / 2;  // starts are four radii apart
  return StartPositions(limits, options.first + options.robots, options.seed);
}

Robot RobotOf(const RobotOptions& options, std::size_t number, const Vector3& position_m) {
  RobotLimits limits = options.limits;
  limits.base.places = 1 + (options.first + options.robots) / kMeetAtOne;
  return Robot(limits, position_m, options.seed + (number + 1) * 0x10001);
}

std::string RobotName(std::size_t number) { return "robot-" + std::to_string(number); }

AgentDescription LinkDescription(const RobotOptions& options, std::size_t number, std::size_t link,
                                 const std::shared_ptr<const Shape>& shape) {
  AgentDescription description;
  description.assembly = RobotName(number);
  description.name = description.assembly + "/" + std::to_string(link);
  description.class_name = options.class_name;
  description.radius_m = shape->radius_m();
  description.acceleration_max_m_s2 = LinkAccelerationMax(options.limits, link);
  description.angular_acceleration_max_rad_s2 = options.limits.turn.angular_acceleration_max_rad_s2;
  description.shape = shape;
  return description;
}

Robots::Robots(const RobotOptions& options, Pace* pace, MotionLog* log)
    : options_(options), pace_(pace) {
  const std::shared_ptr<const Shape> shapes[] = {LinkShape(options.limits, 0),
                                                 LinkShape(options.limits, 1)};
  const std::vector<Vector3> starts = RobotPositions(options);
  for (std::size_t number = options.first; number < starts.size(); ++number) {
    members_.push_back({RobotOf(options, number, starts[number]), {}});
    for (std::size_t link = 0; link < options.limits.links; ++link) {
      const AgentDescription description = LinkDescription(options, number, link, shapes[link % 2]);
      members_.back().links.emplace_back(description, pace, log);
    }
  }
}

void Robots::SetStates(std::int64_t stamp_ns) {
  for (Member& member : members_) {
    for (std::size_t link = 0; link < member.links.size(); ++link) {
      member.links[link].SetState(member.robot.states()[link], stamp_ns, false, {});
    }
  }
}

void Robots::StepTo(const PaceStep& step) {
  for (Member& member : members_) {
    const std::vector<RigidStep> motions = member.robot.Step(step.t0_ns, step.t1_ns);
    for (std::size_t link = 0; link < motions.size(); ++link) member.links[link].Log(motions[link]);
  }
  if (step.with_states) SetStates(step.t1_ns);
}

void Robots::Move() {
  SetStates(pace_->start_ns());
  pace_->Fly(options_.rate_hz, options_.state_every, [this](const PaceStep& step) {
    StepTo(step);
    return true;
  });
  pace_->Linger();
}

}  // namespace collision::client
