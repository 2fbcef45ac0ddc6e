#include "client/library/network/dds_transport.h"

#include <map>
#include <optional>
#include <string>

#include "idl/dds/session.h"

namespace collision::client {
namespace {

/// Messages taken by one call; the rest follows with the next, so that a flood cannot keep the
/// caller waiting.
constexpr std::size_t kArrivalsMax = 65536;

DdsSessionOptions Options(DdsRole role, const Place& place) {
  DdsSessionOptions options;
  options.role = role;
  options.world = place.world;
  options.domain = place.domain;
  options.credentials = place.credentials;
  return options;
}

class DdsTransport : public Transport {
 public:
  explicit DdsTransport(const DdsSessionOptions& options) : session_(options) {}

  void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) override {
    session_.Receive(timeout, kArrivalsMax, &arrivals->inputs, &arrivals->outputs);
  }

  std::optional<std::string> TakeCredentialsWarning() override {
    return session_.TakeCredentialsWarning();
  }

  bool service_alive() const override { return session_.service_present(); }

  void Write(const v1::Input& message) override {
    switch (message.message_case()) {
      case v1::Input::kSimulatorHello:
        return session_.Write(message.simulator_hello());
      case v1::Input::kWatch:
        return session_.Write(message.watch());
      case v1::Input::kAgentDescription:
        return session_.Write(message.agent_description());
      case v1::Input::kShapePart:
        return WritePart(message.shape_part());
      case v1::Input::kAgentStates:
        return session_.Write(message.agent_states());
      case v1::Input::kSimulatorClock:
        return session_.Write(message.simulator_clock());
      case v1::Input::kAgentRemoval:
        return session_.RemoveAgent(message.agent_removal());
      case v1::Input::kShapeRemoval:
        return RemoveShape(message.shape_removal());
      case v1::Input::kOperatorCommand:
        return session_.Write(message.operator_command());
      default:
        return;
    }
  }

  void Flush() override { session_.Flush(); }

 private:
  void WritePart(const v1::ShapePart& part) {
    parts_[part.shape()] = part.parts();
    session_.Write(part);
  }

  /// Each part is an instance of its own; the message does not say how many parts there are.
  void RemoveShape(const v1::ShapeRemoval& removal) {
    const auto parts = parts_.find(removal.shape());
    if (parts == parts_.end()) return;
    session_.RemoveShape(removal.simulator_id(), removal.shape(), parts->second);
    parts_.erase(parts);
  }

  DdsSession session_;
  std::map<std::uint32_t, std::uint32_t> parts_;  ///< Of each shape written, by its number.
};

}  // namespace

std::unique_ptr<Transport> ConnectSimulator(const Place& place, const std::string& simulator) {
  DdsSessionOptions options = Options(DdsRole::kSimulator, place);
  options.simulator = simulator;
  return std::make_unique<DdsTransport>(options);
}

std::unique_ptr<Transport> ConnectOperator(const Place& place) {
  return std::make_unique<DdsTransport>(Options(DdsRole::kOperator, place));
}

std::unique_ptr<Transport> ConnectWatcher(const Place& place) {
  return std::make_unique<DdsTransport>(Options(DdsRole::kWatcher, place));
}

std::unique_ptr<Receiver> ConnectStatusReader(const Place& place) {
  DdsSessionOptions session = Options(DdsRole::kMonitor, place);
  session.reads_status_alone = true;
  return std::make_unique<DdsTransport>(session);
}

std::unique_ptr<Receiver> ConnectMonitor(const MonitorOptions& options) {
  DdsSessionOptions session =
      Options(DdsRole::kMonitor, {options.world, options.domain, options.credentials});
  session.reads_service = options.service;
  session.reads_simulators = options.simulators;
  return std::make_unique<DdsTransport>(session);
}

}  // namespace collision::client
