// A bus and a clock whose every step the test writes.
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/bus/bus.h"
#include "server/bus/clock.h"
#include "server/config/config.h"
#include "server/service/daemon.h"

namespace collision::server {

class ScriptedBus final : public Bus, public Clock {
 public:
  bool Receive(std::chrono::nanoseconds timeout, std::size_t,
               std::vector<v1::Input>* inputs) override {
    timeout_ns = timeout.count();
    *inputs = std::exchange(next, {});
    return !ended;
  }
  void Publish(const v1::Output& output) override { outputs.push_back(output); }
  void Flush() override { ++flushes; }
  void Wake() override { woken = true; }
  std::uint32_t earliest_readers() const override { return earliest_read_by; }
  std::vector<v1::Counter> network_counters() const override { return counters; }
  std::vector<std::string> flooding() const override { return floods; }
  ClockReading Read() override {
    return {.wall_ns = wall_ns,
            .monotonic_ns = monotonic_ns,
            .wall_was_set = std::exchange(wall_was_set, false)};
  }

  /// Both clocks go on.
  void Pass(std::int64_t ns) {
    wall_ns += ns;
    monotonic_ns += ns;
  }

  std::vector<v1::Input> next;
  std::vector<v1::Output> outputs;
  std::vector<v1::Counter> counters;
  std::vector<std::string> floods;
  std::int64_t wall_ns = 1'700'000'000'000'000'000;
  std::int64_t monotonic_ns = 0;
  bool wall_was_set = false;  ///< What the next reading says.
  std::int64_t timeout_ns = -1;
  std::uint32_t earliest_read_by = 1;
  int flushes = 0;
  bool ended = false;
  bool woken = false;
};

/// The default configuration with a simulated clock.
inline v1::Config Simulated() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::LOCK_STEP);
  return config;
}

/// Simulated time that begins with two simulators. The silent are named after 3 s, released after
/// 8 s where they are, and then removed after 20 s.
inline v1::Config OfTwoSimulators(v1::Clock::OnSilent on_silent) {
  v1::Config config = Simulated();
  config.mutable_clock()->set_simulators_awaited(2);
  config.mutable_clock()->set_on_silent_simulator(on_silent);
  if (on_silent == v1::Clock::RELEASE) config.mutable_clock()->set_release_after_s(8);
  config.mutable_clock()->set_waiting_after_s(3);
  config.mutable_clock()->set_remove_silent_after_s(20);
  return config;
}

/// A daemon on a scripted bus.
class ScriptedDaemon {
 public:
  explicit ScriptedDaemon(v1::Config config, BatchSink* recorder = nullptr,
                          std::unique_ptr<ShapeBuilder> shape_builder = nullptr)
      : daemon_(CompleteConfig(std::move(config)), bus_, bus_,
                {.recorder = recorder, .shape_builder = std::move(shape_builder)}) {}

  ScriptedDaemon(v1::Config config, DaemonParts parts)
      : daemon_(CompleteConfig(std::move(config)), bus_, bus_, std::move(parts)) {}

  /// One step `seconds` later with these inputs.
  void Step(std::vector<v1::Input> inputs, double seconds = 0) {
    bus_.Pass(static_cast<std::int64_t>(seconds * 1e9));
    bus_.next = std::move(inputs);
    if (!daemon_.Step()) throw std::logic_error("the daemon has ended");
  }

  /// Nothing arrives for so long. One step of it would be a standstill.
  void Pass(double seconds) {
    for (; seconds > 1; --seconds) Step({}, 1);
    Step({}, seconds);
  }

  ScriptedBus& bus() { return bus_; }
  Daemon& daemon() { return daemon_; }

  std::vector<v1::Rejection> rejections() const {
    std::vector<v1::Rejection> all;
    for (const v1::Output& output : bus_.outputs) {
      if (output.has_rejection()) all.push_back(output.rejection());
    }
    return all;
  }

  /// The newest clearance sample of a chunk; throws if there is none.
  v1::Clearance clearance(std::uint64_t simulator_id, std::uint32_t chunk = 0) const {
    for (auto output = bus_.outputs.rbegin(); output != bus_.outputs.rend(); ++output) {
      if (!output->has_clearance()) continue;
      const v1::Clearance& clearance = output->clearance();
      if (clearance.simulator_id() == simulator_id && clearance.chunk() == chunk) return clearance;
    }
    throw std::logic_error("no clearance was published");
  }

  /// A status of now: a period later.
  v1::ServiceStatus status() {
    Step({}, 1);
    for (auto output = bus_.outputs.rbegin(); output != bus_.outputs.rend(); ++output) {
      if (output->has_service_status()) return output->service_status();
    }
    throw std::logic_error("no status was published");
  }

  std::uint64_t counter(const std::string& name) {
    const v1::ServiceStatus now = status();
    for (const v1::Counter& counter : now.counters()) {
      if (counter.name() == name) return counter.value();
    }
    throw std::logic_error("no counter " + name);
  }

 private:
  ScriptedBus bus_;
  Daemon daemon_;
};

}  // namespace collision::server
