#include "tests/faults/topics.h"

namespace collision::faults {
namespace {

template <typename... Parts>
std::string Key(Parts... parts) {
  std::string key;
  ((key += std::to_string(parts) + "/"), ...);
  return key;
}

}  // namespace

Address AddressOf(const v1::Input& message) {
  switch (message.message_case()) {
    case v1::Input::kAgentDescription: {
      const v1::AgentDescription& m = message.agent_description();
      return {Topic::kDescription, Key(m.simulator_id(), m.slot(), m.incarnation())};
    }
    case v1::Input::kAgentRemoval: {
      const v1::AgentRemoval& m = message.agent_removal();
      return {Topic::kDescription, Key(m.simulator_id(), m.slot(), m.incarnation())};
    }
    case v1::Input::kShapePart: {
      const v1::ShapePart& m = message.shape_part();
      return {Topic::kShape, Key(m.simulator_id(), m.shape(), m.part())};
    }
    case v1::Input::kShapeRemoval: {
      const v1::ShapeRemoval& m = message.shape_removal();
      return {Topic::kShape, Key(m.simulator_id(), m.shape(), m.part())};
    }
    case v1::Input::kAgentStates: {
      const v1::AgentStates& m = message.agent_states();
      return {Topic::kStates, Key(m.simulator_id(), m.chunk(), m.incarnation())};
    }
    case v1::Input::kSimulatorHello: {
      const v1::SimulatorHello& m = message.simulator_hello();
      return {Topic::kSimulatorHello, Key(m.simulator_id(), m.incarnation())};
    }
    case v1::Input::kOperatorCommand:
      return {Topic::kCommand, Key(message.operator_command().command_id())};
    default: {
      const v1::SimulatorClock& m = message.simulator_clock();
      return {Topic::kClock, Key(m.simulator_id(), m.incarnation())};
    }
  }
}

Address AddressOf(const v1::Output& message) {
  switch (message.message_case()) {
    case v1::Output::kClearance:
      return {Topic::kClearance,
              Key(message.clearance().simulator_id(), message.clearance().chunk())};
    case v1::Output::kEarliestIntersection:
      return {Topic::kEarliest, Key(message.earliest_intersection().service_id())};
    case v1::Output::kCollisionEvent: {
      const bool contact = message.collision_event().contacts_sequence() > 0;
      return {contact ? Topic::kContact : Topic::kForecast,
              Key(message.collision_event().pair_slot())};
    }
    case v1::Output::kRejection:
      return {Topic::kRejection, Key(message.rejection().simulator_id())};
    case v1::Output::kServiceHello:
      return {Topic::kServiceHello, Key(message.service_hello().service_id())};
    case v1::Output::kSimulatorReport:
      return {Topic::kReport, Key(message.simulator_report().simulator_id())};
    case v1::Output::kAgentBreach:
      return {Topic::kBreach,
              Key(message.agent_breach().simulator_id(), message.agent_breach().slot())};
    case v1::Output::kScreeningEvent:
      return {Topic::kScreening,
              Key(message.screening_event().simulator_id(), message.screening_event().pair_slot())};
    default:
      return {Topic::kStatus, Key(message.service_status().service_id())};
  }
}

}  // namespace collision::faults
