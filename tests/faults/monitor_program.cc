#include "tests/faults/monitor_program.h"

#include <memory>
#include <utility>

namespace collision::faults {
namespace {

constexpr std::int64_t kThinkingTime = 50'000;
constexpr std::int64_t kLookingPeriod = 100 * kMillisecond;

}  // namespace

MonitorProgram::MonitorProgram(Network* network) : network_(*network) {}

void MonitorProgram::Start() {
  auto end = std::make_unique<ClientEnd>(&network_, Role::kMonitor, 0,
                                         [this] { Wake(network_.now_ns() + kThinkingTime); });
  end_ = end.get();
  client::MessageMonitor::Callbacks callbacks;
  callbacks.event = [this](const v1::CollisionEvent& event) { Hear(event); };
  callbacks.status = [this](const v1::ServiceStatus& status) {
    const OnBehalfOf test(Owner::kTest);
    const std::uint64_t id = status.stamp().service_id();
    if (services_.empty() || services_.back() != id) services_.push_back(id);
    status_ = status;
  };
  const OnBehalfOf client(Owner::kClients);
  monitor_.emplace(std::move(end), callbacks);
  Wake(network_.now_ns());
}

void MonitorProgram::GoOn() {
  reads_ = true;
  Wake(network_.now_ns());
}

void MonitorProgram::Wake(std::int64_t at_ns) {
  if (!reads_ || awaits_) return;
  awaits_ = true;
  const OnBehalfOf test(Owner::kTest);
  network_.At(at_ns, [this] {
    awaits_ = false;
    if (!reads_) return;
    {
      const OnBehalfOf client(Owner::kClients);
      monitor_->Poll(std::chrono::nanoseconds(0));
    }
    network_.After(kLookingPeriod, [this] { Wake(network_.now_ns()); });
  });
}

void MonitorProgram::Hear(const v1::CollisionEvent& event) {
  const OnBehalfOf test(Owner::kTest);
  heard_.push_back({network_.now_ns(), event});
  if (event.contacts_sequence() == 0) return;
  std::set<std::uint64_t>& heard = contacts_[event.stamp().service_id()];
  if (!heard.empty() && event.contacts_sequence() <= *heard.rbegin()) ++out_of_order_;
  heard.insert(event.contacts_sequence());
}

}  // namespace collision::faults
