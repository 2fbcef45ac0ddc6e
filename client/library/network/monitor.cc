#include "collision/monitor.h"

#include <utility>

#include "client/library/network/conversion.h"
#include "client/library/network/message_monitor.h"

namespace collision::client {
namespace {

/// Converts what the caller wants to know, and nothing else.
template <typename Value, typename Message>
void Convert(const std::function<void(const Value&)>& plain,
             std::function<void(const Message&)>* converting) {
  if (plain) *converting = [plain](const Message& message) { plain(FromMessage(message)); };
}

MessageMonitor::Callbacks Converting(const Monitor::Callbacks& plain) {
  MessageMonitor::Callbacks callbacks;
  Convert(plain.event, &callbacks.event);
  Convert(plain.earliest, &callbacks.earliest);
  Convert(plain.status, &callbacks.status);
  Convert(plain.rejection, &callbacks.rejection);
  Convert(plain.breach, &callbacks.breach);
  Convert(plain.description, &callbacks.description);
  Convert(plain.clock, &callbacks.clock);
  callbacks.notice = plain.notice;
  if (plain.clearance) {
    callbacks.clearance = [hear = plain.clearance](const v1::Clearance& message) {
      for (const v1::AgentClearance& agent : message.agents()) {
        hear({message.simulator_id(), message.run(), agent.slot(), agent.generation()},
             FromMessage(agent));
      }
    };
  }
  if (plain.removal) {
    callbacks.removal = [hear = plain.removal](const v1::AgentRemoval& message) {
      hear(message.simulator_id(), message.slot());
    };
  }
  if (plain.state) {
    callbacks.states = [hear = plain.state](const v1::AgentStates& message) {
      for (const v1::AgentState& state : message.states()) {
        hear({message.simulator_id(), message.run(), state.slot(), state.generation()},
             FromMessage(state));
      }
    };
  }
  return callbacks;
}

}  // namespace

Monitor::Monitor(const MonitorOptions& options, const Callbacks& callbacks)
    : monitor_(std::make_unique<MessageMonitor>(options, Converting(callbacks))) {}

Monitor::Monitor(std::unique_ptr<Receiver> receiver, const Callbacks& callbacks)
    : monitor_(std::make_unique<MessageMonitor>(std::move(receiver), Converting(callbacks))) {}

Monitor::Monitor(Monitor&&) noexcept = default;
Monitor& Monitor::operator=(Monitor&&) noexcept = default;
Monitor::~Monitor() = default;

std::size_t Monitor::Poll(std::chrono::nanoseconds timeout) { return monitor_->Poll(timeout); }

bool Monitor::service_alive() const { return monitor_->service_alive(); }

std::uint64_t Monitor::contacts_missed() const { return monitor_->contacts_missed(); }

}  // namespace collision::client
