// A network under the test's control, and what a service would say on it.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "client/library/network/transport.h"
#include "collision/world.h"
#include "idl/identity.h"

namespace collision::client {

inline constexpr char kSimulator[] = "tester";
inline constexpr std::uint32_t kRun = 7;
inline constexpr std::uint32_t kIncarnation = 4711;  ///< Shapes are numbered from here.

/// Shared by the test and the transport; outlives the World that owns the transport.
struct FakeNetwork {
  std::vector<v1::Input> written;  ///< What the World wrote, in order, but its hello.
  v1::SimulatorHello hello;
  std::deque<v1::Output> arriving;              ///< What the next Receive() hands over.
  std::vector<v1::Input> heard;                 ///< Likewise, of services.
  std::vector<std::chrono::nanoseconds> waits;  ///< The timeout of every Receive().
  std::size_t flushed = 0;                      ///< How much of `written` has left.
  bool alive = false;
  std::chrono::nanoseconds later{0};  ///< Than the steady clock, for the World.
  /// Called when the World waits and nothing is arriving: the service's turn to answer.
  std::function<void(FakeNetwork*)> on_wait;

  /// The messages of one kind, in order.
  std::vector<v1::SimulatorClock> Clocks() const {
    std::vector<v1::SimulatorClock> clocks;
    for (const v1::Input& input : written) {
      if (input.has_simulator_clock()) clocks.push_back(input.simulator_clock());
    }
    return clocks;
  }

  std::vector<v1::AgentStates> States() const {
    std::vector<v1::AgentStates> states;
    for (const v1::Input& input : written) {
      if (input.has_agent_states()) states.push_back(input.agent_states());
    }
    return states;
  }

  /// On this simulator, by the service of term 1, which is alive.
  void Report(std::uint32_t run, std::uint32_t incarnation, bool owner_alive) {
    alive = true;
    v1::SimulatorReport* report = arriving.emplace_back().mutable_simulator_report();
    report->set_simulator_id(SimulatorId(kSimulator));
    report->mutable_stamp()->set_service_id(1);
    report->mutable_stamp()->set_term(1);
    report->set_run(run);
    report->set_incarnation(incarnation);
    report->set_alive(owner_alive);
  }

  void Grant(std::int64_t until_ns, std::uint32_t term = 1, std::uint32_t run = kRun) {
    v1::Clearance* clearance = arriving.emplace_back().mutable_clearance();
    clearance->set_simulator_id(SimulatorId(kSimulator));
    clearance->set_run(run);
    clearance->mutable_stamp()->set_service_id(term);  // each term has a service of its own
    clearance->mutable_stamp()->set_term(term);
    clearance->set_granted_until_ns(until_ns);
  }
};

class FakeTransport : public Transport {
 public:
  explicit FakeTransport(std::shared_ptr<FakeNetwork> network) : network_(std::move(network)) {}

  void Write(const v1::Input& message) override {
    if (message.has_simulator_hello()) {
      network_->hello = message.simulator_hello();
    } else {
      network_->written.push_back(message);
    }
  }

  void Flush() override { network_->flushed = network_->written.size(); }

  void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) override {
    network_->waits.push_back(timeout);
    if (timeout.count() > 0 && network_->arriving.empty() && network_->on_wait) {
      network_->on_wait(network_.get());
    }
    arrivals->outputs.insert(arrivals->outputs.end(), network_->arriving.begin(),
                             network_->arriving.end());
    network_->arriving.clear();
    arrivals->inputs = std::exchange(network_->heard, {});
  }

  bool service_alive() const override { return network_->alive; }

  std::chrono::steady_clock::time_point Now() const override {
    return Transport::Now() + network_->later;
  }

 private:
  std::shared_ptr<FakeNetwork> network_;
};

inline World ConnectTo(const std::shared_ptr<FakeNetwork>& network, WorldOptions options = {}) {
  options.simulator = kSimulator;
  options.run = kRun;
  options.incarnation = kIncarnation;
  return World::Connect(options, std::make_unique<FakeTransport>(network));
}

/// One that the library takes, without an extent and without acceleration.
inline AgentDescription Point(const std::string& name = "ball") {
  return {.name = name, .radius_m = 0, .acceleration_max_m_s2 = 0};
}

/// An event between this simulator's agent in slot 0 and another simulator's agent.
inline v1::CollisionEvent OwnEvent(std::uint32_t contact, std::uint32_t revision,
                                   std::uint64_t sequence) {
  v1::CollisionEvent event;
  event.mutable_stamp()->set_service_id(1);
  event.mutable_stamp()->set_term(1);
  event.mutable_stamp()->set_sequence(sequence);
  event.mutable_lower()->set_simulator_id(SimulatorId(kSimulator));
  event.mutable_lower()->set_run(kRun);
  event.mutable_lower()->set_generation(1);
  event.mutable_higher()->set_simulator_id(1);
  event.set_contact(contact);
  event.set_revision(revision);
  return event;
}

}  // namespace collision::client
