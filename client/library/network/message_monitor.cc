#include "client/library/network/message_monitor.h"

#include <utility>

#include "client/library/network/dds_transport.h"
#include "client/library/validation.h"

namespace collision::client {
namespace {

template <typename Message>
void Call(const std::function<void(const Message&)>& callback, const Message& message) {
  if (callback) callback(message);
}

std::unique_ptr<Receiver> Connect(const MonitorOptions& options) {
  ValidateWorld(options.world, options.domain);
  return ConnectMonitor(options);
}

}  // namespace

MessageMonitor::MessageMonitor(const MonitorOptions& options, Callbacks callbacks)
    : MessageMonitor(Connect(options), std::move(callbacks)) {}

MessageMonitor::MessageMonitor(std::unique_ptr<Receiver> receiver, Callbacks callbacks)
    : receiver_(std::move(receiver)), callbacks_(std::move(callbacks)) {}

std::size_t MessageMonitor::Poll(std::chrono::nanoseconds timeout) {
  Arrivals arrivals;
  receiver_->Receive(timeout, &arrivals);
  for (const v1::Input& input : arrivals.inputs) HandOn(input);
  for (const v1::Output& output : arrivals.outputs) HandOn(output);
  return arrivals.inputs.size() + arrivals.outputs.size();
}

void MessageMonitor::HandOn(const v1::Input& input) const {
  switch (input.message_case()) {
    case v1::Input::kAgentDescription:
      return Call(callbacks_.description, input.agent_description());
    case v1::Input::kAgentRemoval:
      return Call(callbacks_.removal, input.agent_removal());
    case v1::Input::kShapePart:
      return Call(callbacks_.shape_part, input.shape_part());
    case v1::Input::kShapeRemoval:
      return Call(callbacks_.shape_removal, input.shape_removal());
    case v1::Input::kAgentStates:
      return Call(callbacks_.states, input.agent_states());
    case v1::Input::kSimulatorClock:
      return Call(callbacks_.clock, input.simulator_clock());
    default:
      return;
  }
}

void MessageMonitor::HandOn(const v1::Output& output) const {
  switch (output.message_case()) {
    case v1::Output::kClearance:
      return Call(callbacks_.clearance, output.clearance());
    case v1::Output::kEarliestIntersection:
      return Call(callbacks_.earliest, output.earliest_intersection());
    case v1::Output::kCollisionEvent:
      return Call(callbacks_.event, output.collision_event());
    case v1::Output::kRejection:
      return Call(callbacks_.rejection, output.rejection());
    case v1::Output::kServiceStatus:
      return Call(callbacks_.status, output.service_status());
    case v1::Output::kSimulatorReport:
      return Call(callbacks_.report, output.simulator_report());
    default:
      return;
  }
}

}  // namespace collision::client
