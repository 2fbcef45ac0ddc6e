#include "client/programs/simulators/motion/ship_agent.h"

#include "collision/shape.h"

namespace collision::client {

ShipAgent::ShipAgent(const AgentDescription& description, Pace* pace, MotionLog* log)
    : description_(description), pace_(pace), log_(log) {
  if (description_.shape) description_.radius_m = description_.shape->radius_m();
}

void ShipAgent::SetState(const RigidState& body, std::int64_t stamp_ns, bool discontinuity,
                         const ThrustBound& thrust) {
  State state;
  state.stamp_ns = stamp_ns;
  state.position_m = body.position_m;
  state.velocity_m_s = body.velocity_m_s;
  state.orientation = body.orientation;
  state.angular_velocity_rad_s = body.angular_velocity_rad_s;
  state.position_error_m = kShipPositionError;
  state.velocity_error_m_s = kShipPositionError;
  state.rotation_error_rad = kShipRotationError;
  if (thrust.direction != Vector3{}) state.thrust_direction = thrust.direction;
  state.direction_until_ns = thrust.until_ns;
  state.discontinuity = discontinuity;
  if (agent_) {
    agent_->SetState(state);
    return;
  }
  agent_.emplace(pace_->world().AddAgent(description_, state));  // Checks that it has a radius.
  log_->Agent(description_.name, *description_.radius_m, description_.shape);
  log_->Assembly(description_.name, description_.assembly);
  log_->Class(description_.name, description_.class_name);
}

void ShipAgent::Log(const RigidStep& step) {
  log_->Piece(description_.name, step.piece);
  if (description_.shape) log_->Turn(description_.name, step.turn);
}

void ShipAgent::Handle(const Event& event) {
  if (agent_) contacts_.Handle(event, agent_->id());
}

bool ShipAgent::Answer(std::int64_t now_ns, RigidState* state) {
  bool bounced = false;
  for (const ShipContact& contact : contacts_.Take(*state, now_ns)) {
    bounced = BounceOff(contact, *description_.radius_m, state) || bounced;
  }
  if (bounced) log_->Jump(description_.name, now_ns);
  return bounced;
}

}  // namespace collision::client
