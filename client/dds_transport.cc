#include "client/dds_transport.h"

#include <utility>

#include "idl/dds/session.h"

namespace collision::client {
namespace {

/// Messages taken at once; the rest follows with the next call, so that a flood cannot hold the
/// caller.
constexpr std::size_t kArrivalsMax = 65536;

DdsSessionOptions Options(DdsRole role, const std::string& world, std::uint32_t domain) {
  DdsSessionOptions options;
  options.role = role;
  options.world = world;
  options.domain = domain;
  return options;
}

class DdsTransport : public Transport {
 public:
  explicit DdsTransport(const DdsSessionOptions& options) : session_(options) {}

  void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) override {
    session_.Receive(timeout, kArrivalsMax, &arrivals->inputs, &arrivals->outputs);
  }

  bool service_alive() const override { return session_.service_present(); }

  void Write(const v1::Input& message) override {
    switch (message.message_case()) {
      case v1::Input::kAgentDescription:
        return session_.Write(message.agent_description());
      case v1::Input::kShapePart:
        return session_.Write(message.shape_part());
      case v1::Input::kAgentStates:
        return session_.Write(message.agent_states());
      case v1::Input::kSimulatorClock:
        return session_.Write(message.simulator_clock());
      case v1::Input::kAgentRemoval:
        return session_.RemoveAgent(message.agent_removal().simulator_id(),
                                    message.agent_removal().slot());
      default:
        return;
    }
  }

  void Flush() override { session_.Flush(); }

 private:
  DdsSession session_;
};

}  // namespace

std::unique_ptr<Transport> ConnectSimulator(const std::string& world, const std::string& simulator,
                                            std::uint32_t domain) {
  DdsSessionOptions options = Options(DdsRole::kSimulator, world, domain);
  options.simulator = simulator;
  return std::make_unique<DdsTransport>(options);
}

std::unique_ptr<Receiver> ConnectMonitor(const MonitorOptions& options) {
  DdsSessionOptions session = Options(DdsRole::kMonitor, options.world, options.domain);
  session.reads_service = options.service;
  session.reads_simulators = options.simulators;
  return std::make_unique<DdsTransport>(session);
}

}  // namespace collision::client
