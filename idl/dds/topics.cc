#include "idl/dds/topics.h"

#include "idl/limits.h"

namespace collision::dds {

const std::array<TopicRow, kTopics>& Topics() {
  using enum TopicId;
  using enum Source;
  static const std::array<TopicRow, kTopics> rows = {{
      {kSimulatorHello, "collision/v1/simulator_hello", &collision_v1_SimulatorHello_desc,
       kSimulators, 1, 1, 1, false, kAll},
      {kSimulatorClock, "collision/v1/simulator_clock", &collision_v1_SimulatorClock_desc,
       kSimulators, 1, 1, 8, true, kAll},
      {kAgentDescription, "collision/v1/agent_description", &collision_v1_AgentDescription_desc,
       kSimulators, 1, 1, 1, false, kAll},
      {kShapePart, "collision/v1/shape", &collision_v1_ShapePart_desc, kSimulators, 1, 1, 1, false,
       kAll},
      {kAgentStates, "collision/v1/agent_states", &collision_v1_AgentStates_desc, kSimulators, 1, 1,
       32, false, kAll},
      {kServiceHello, "collision/v1/hello", &collision_v1_ServiceHello_desc, kService, 1, 1, 1,
       false, kAll},
      {kClearance, "collision/v1/clearance", &collision_v1_Clearance_desc, kService, 1, 1, 1, false,
       kAll},
      {kEarliestIntersection, "collision/v1/earliest_intersection",
       &collision_v1_EarliestIntersection_desc, kService, 1, 1, 64, false, kAll},
      {kContact, "collision/v1/contact", &collision_v1_CollisionEvent_desc, kService,
       wire::kContactsForLateJoiners, wire::kContactsKept, wire::kContactsKept, false, kAll},
      {kForecast, "collision/v1/forecast", &collision_v1_CollisionEvent_desc, kService, 1,
       wire::kForecastsKept, wire::kForecastsKept, false, kAll},
      {kRejection, "collision/v1/rejection", &collision_v1_Rejection_desc, kService, 0, 64, 64,
       false, kAll},
      {kServiceStatus, "collision/v1/service_status", &collision_v1_ServiceStatus_desc, kService, 1,
       1, 1, true, kAll},
      {kSimulatorReport, "collision/v1/simulator_report", &collision_v1_SimulatorReport_desc,
       kService, 1, 1, 1, false, kAll},
      {kAgentBreach, "collision/v1/agent_breach", &collision_v1_AgentBreach_desc, kService, 1, 1, 1,
       false, kAll},
      {kScreening, "collision/v1/screening", &collision_v1_ScreeningEvent_desc, kService, 1, 1, 1,
       false, kAll},
      {kOperatorCommand, "collision/v1/operator_command", &collision_v1_OperatorCommand_desc,
       kOperators, 1, 1, 1, false, kCommandsAtOnce},
      {kWatch, "collision/v1/watch", &collision_v1_Watch_desc, kWatchers, 1, 1, 1, false, kAll},
  }};
  return rows;
}

}  // namespace collision::dds
