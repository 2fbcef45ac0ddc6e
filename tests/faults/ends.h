// The ends of the faulty network: the service's bus, the client library's transport.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "client/library/network/transport.h"
#include "server/bus/bus.h"
#include "tests/faults/heap.h"
#include "tests/faults/network.h"

namespace collision::faults {

/// Never waits: who steps the daemon knows when something has come, and asks after each step how
/// long it would have waited.
class ServiceEnd final : public server::Bus {
 public:
  ServiceEnd(Network* network, std::function<void()> arrived,
             std::function<void(const v1::Output&)> published)
      : network_(*network),
        id_(network->Join(Role::kService, 0, std::move(arrived))),
        published_(std::move(published)) {}

  bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
               std::vector<v1::Input>* inputs) override {
    timeout_ns_ = timeout.count();
    network_.Take(id_, limit, inputs, nullptr);
    received_ = inputs->size();
    return true;
  }
  void Publish(const v1::Output& output) override {
    const OnBehalfOf test(Owner::kTest);
    published_(output);
    network_.Write(id_, output);
  }
  void Flush() override {}
  void Wake() override {}

  Network::Id id() const { return id_; }
  /// What the last Receive() was asked and gave.
  std::int64_t timeout_ns() const { return timeout_ns_; }
  std::size_t received() const { return received_; }

 private:
  Network& network_;
  const Network::Id id_;
  std::function<void(const v1::Output&)> published_;
  std::int64_t timeout_ns_ = 0;
  std::size_t received_ = 0;
};

/// Never waits; its time is the network's.
class ClientEnd final : public client::Transport {
 public:
  /// Before any program joins, virtual time is not 0: a library must not take 0 for a time.
  static constexpr std::int64_t kMonotonicAtStart = 1000 * kSecond;

  ClientEnd(Network* network, Role role, std::uint64_t simulator, std::function<void()> arrived)
      : network_(*network), id_(network->Join(role, simulator, std::move(arrived))) {}

  void Receive(std::chrono::nanoseconds, client::Arrivals* arrivals) override {
    network_.Take(id_, std::numeric_limits<std::size_t>::max(), &arrivals->inputs,
                  &arrivals->outputs);
  }
  bool service_alive() const override { return network_.service_alive(id_); }
  std::chrono::steady_clock::time_point Now() const override {
    return std::chrono::steady_clock::time_point(
        std::chrono::nanoseconds(kMonotonicAtStart + network_.now_ns()));
  }
  void Write(const v1::Input& message) override {
    const OnBehalfOf test(Owner::kTest);
    network_.Write(id_, message);
  }
  void Flush() override {}

  Network::Id id() const { return id_; }

 private:
  Network& network_;
  const Network::Id id_;
};

}  // namespace collision::faults
