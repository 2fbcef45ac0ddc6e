// A daemon and simulators in one thread, with a network delay that the test chooses.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "client/library/network/transport.h"
#include "collision/world.h"
#include "idl/identity.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::client {

/// Carries what simulators write to the daemon, and its outputs to their receivers; keeps a copy.
class InProcessService {
 public:
  /// `late`: steps of the daemon until its outputs arrive.
  InProcessService(const v1::Config& config, std::size_t late) : daemon_(config), late_(late) {}

  void Send(std::uint64_t sender, const v1::Input& message) {
    inputs_.push_back(message);
    inputs_.back().set_sender(sender);
  }

  /// One step of the daemon, `seconds` of monotonic time after the last.
  void Step(double seconds) {
    daemon_.Step(std::exchange(inputs_, {}), seconds);
    steps_.push_back(std::exchange(daemon_.bus().outputs, {}));
    for (const v1::Output& output : steps_.back()) said_.push_back(output);
    if (steps_.size() <= late_) return;
    for (const v1::Output& output : steps_.front()) {
      if (output.has_simulator_report()) {
        reports_[output.simulator_report().simulator_id()] = output;
      }
      for (auto& [sender, inbox] : inboxes_) inbox.push_back(output);
    }
    steps_.pop_front();
  }

  /// The clocks of the daemon, for tests that set them.
  server::ScriptedBus& clocks() { return daemon_.bus(); }

  /// A world over this service, for a simulator with this sender id.
  World Connect(std::uint64_t sender, WorldOptions options);

  /// The program with this sender is gone: its simulator's lease is over.
  void End(std::uint64_t sender, const std::string& simulator) {
    inputs_.push_back(server::Liveliness(sender, simulator, false));
    inboxes_.erase(sender);
  }

  const std::vector<v1::Output>& said() const { return said_; }
  server::ScriptedDaemon& daemon() { return daemon_; }

 private:
  class Line;

  server::ScriptedDaemon daemon_;
  std::size_t late_;
  std::vector<v1::Input> inputs_;
  std::deque<std::vector<v1::Output>> steps_;
  std::map<std::uint64_t, std::vector<v1::Output>> inboxes_;
  std::map<std::uint64_t, v1::Output> reports_;  ///< The newest ones, for who comes later.
  std::vector<v1::Output> said_;
};

/// Waiting lets the daemon step.
class InProcessService::Line : public Transport {
 public:
  Line(InProcessService* service, std::uint64_t sender, std::uint64_t simulator)
      : service_(*service), sender_(sender), simulator_(simulator) {
    for (const auto& [id, report] : service_.reports_) {
      service_.inboxes_[sender].push_back(report);
    }
    service_.inboxes_[sender];
  }

  void Write(const v1::Input& message) override { service_.Send(sender_, message); }
  void Flush() override {}
  bool service_alive() const override { return true; }

  void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) override {
    std::vector<v1::Output>& inbox = service_.inboxes_[sender_];
    if (timeout.count() > 0 && inbox.empty()) service_.Step(0.001);
    for (const v1::Output& output : std::exchange(inbox, {})) {
      const bool others =
          (output.has_clearance() && output.clearance().simulator_id() != simulator_) ||
          (output.has_rejection() && output.rejection().simulator_id() != simulator_);
      if (!others) arrivals->outputs.push_back(output);
    }
  }

 private:
  InProcessService& service_;
  std::uint64_t sender_;
  std::uint64_t simulator_;
};

inline World InProcessService::Connect(std::uint64_t sender, WorldOptions options) {
  if (options.run == 0) options.run = 1;
  auto line = std::make_unique<Line>(this, sender, SimulatorId(options.simulator));
  return World::Connect(options, std::move(line));
}

/// Lock-step of two simulators, each state in a round of its own.
inline v1::Config RoundsOfTwo() {
  v1::Config config = server::Simulated();
  config.mutable_clock()->set_simulators_awaited(2);
  config.mutable_clock()->set_grant_ahead_max_s(0.1);
  return config;
}

/// Brings both to `clock_ns`.
inline void AdvanceBoth(std::int64_t clock_ns, InProcessService* service, World* a, World* b) {
  for (int tries = 0; tries < 1000; ++tries) {
    const auto one = a->AdvanceTo(clock_ns, std::chrono::nanoseconds(0));
    const auto other = b->AdvanceTo(clock_ns, std::chrono::nanoseconds(0));
    if (one == Advance::kReached && other == Advance::kReached) return;
    service->Step(0.001);
  }
  ADD_FAILURE() << "time stands";
}

}  // namespace collision::client
