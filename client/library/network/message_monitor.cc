#include "client/library/network/message_monitor.h"

#include <cstdio>
#include <utility>

#include "client/library/network/arrival_order.h"
#include "client/library/network/dds_transport.h"
#include "client/library/validation.h"
#include "idl/limits.h"

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
  now_ = receiver_->Now();
  OrderEvents(&arrivals.outputs);
  for (const v1::Output& output : arrivals.outputs) {
    if (output.has_service_hello()) Take(output.service_hello());
  }
  for (const v1::Output& output : arrivals.outputs) {
    if (output.has_service_hello() || unreadable_.contains(StampOf(output).service_id())) continue;
    HandOn(output);
    // Reports are handed on, whoever they are from.
    if (StampOf(output).service_id() != service_.id() && !output.has_simulator_report()) {
      others_.Keep(output, now_);
    }
  }
  // The end of a service comes after all that it wrote.
  for (const v1::Input& input : arrivals.inputs) HandOn(input);
  GiveUpOverdue();
  TellOfCredentials();
  return arrivals.inputs.size() + arrivals.outputs.size();
}

void MessageMonitor::TellOfCredentials() {
  const std::optional<std::string> warning = receiver_->TakeCredentialsWarning();
  if (!warning) return;
  const Notice notice{.kind = NoticeKind::kCredentials, .text = *warning};
  if (callbacks_.notice) return callbacks_.notice(notice);
  std::fprintf(stderr, "%s: %s\n", Name(notice.kind), notice.text.c_str());
}

void MessageMonitor::Take(const v1::ServiceHello& hello) {
  constexpr std::size_t kUnreadableMax = 64;
  if (hello.wire_revision() == wire::kWireRevision) {
    unreadable_.erase(hello.service_id());
  } else {
    if (unreadable_.size() >= kUnreadableMax) unreadable_.clear();
    unreadable_.insert(hello.service_id());
    unreadable_text_ = "the service (version " + hello.version() + ") has wire revision " +
                       std::to_string(hello.wire_revision()) + ", this program " +
                       std::to_string(wire::kWireRevision) + ": use one version for both";
  }
  Call(callbacks_.hello, hello);
}

void MessageMonitor::HandOn(const v1::Input& input) {
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
    case v1::Input::kServiceHeard:
      if (!service_.Hear(input.service_heard())) return;
      for (const v1::Output& status : others_.Statuses(now_)) HandOn(status);
      return;
    default:
      return;
  }
}

void MessageMonitor::HandOn(const v1::Output& output) {
  switch (output.message_case()) {
    case v1::Output::kClearance:
      if (Accept(output.clearance().stamp())) Call(callbacks_.clearance, output.clearance());
      return;
    case v1::Output::kEarliestIntersection:
      if (!Accept(output.earliest_intersection().stamp())) return;
      return Call(callbacks_.earliest, output.earliest_intersection());
    case v1::Output::kCollisionEvent:
      if (!service_.IsPast(output.collision_event().stamp()) &&
          !Accept(output.collision_event().stamp())) {
        return;
      }
      if (!filter_.IsNew(output.collision_event(), &contacts_)) return;
      return Call(callbacks_.event, output.collision_event());
    case v1::Output::kRejection:
      if (Accept(output.rejection().stamp())) Call(callbacks_.rejection, output.rejection());
      return;
    case v1::Output::kAgentBreach:
      if (!Accept(output.agent_breach().stamp())) return;
      return Call(callbacks_.breach, output.agent_breach());
    case v1::Output::kServiceStatus:
      if (output.service_status().phase() == v1::PHASE_CLAIMING) return;
      if (output.service_status().phase() == v1::PHASE_STANDBY) {
        return Call(callbacks_.standby, output.service_status());
      }
      if (!Accept(output.service_status().stamp(), output.service_status().followers() > 0)) return;
      Await(output.service_status());
      return Call(callbacks_.status, output.service_status());
    case v1::Output::kSimulatorReport:
      return Call(callbacks_.report, output.simulator_report());
    default:
      return;
  }
}

bool MessageMonitor::Accept(const v1::ServiceStamp& stamp, bool followed) {
  const std::uint64_t former = service_.id();
  if (!service_.Accept(stamp, now_, followed)) return false;
  if (service_.id() != former) {
    contacts_.Restart();
    awaited_.reset();
    for (const v1::Output& output : others_.Take(service_.id(), now_)) HandOn(output);
  }
  return true;
}

void MessageMonitor::Await(const v1::ServiceStatus& status) {
  for (const v1::Counter& counter : status.counters()) {
    if (counter.name() != wire::kContactsCounter) continue;
    if (counter.value() == 0) contacts_.BeginAtNone();
    if (!awaited_) awaited_ = {counter.value(), now_};
  }
}

void MessageMonitor::GiveUpOverdue() {
  if (!awaited_) return;
  if (now_ - awaited_->since >= kServiceSilence) contacts_.GiveUp(awaited_->sequence);
  if (contacts_.HasAll(awaited_->sequence)) awaited_.reset();
}

}  // namespace collision::client
