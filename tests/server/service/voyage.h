// Runs of a small scene against a daemon, each of which may be followed by the next one.
#pragma once

#include <string>
#include <vector>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {

inline constexpr std::int64_t kTenth = 100'000'000;  ///< [ns] The step of the simulator.
inline constexpr int kSteps = 10;

inline v1::Config VoyageConfig(v1::Clock::OnSilent on_silent = v1::Clock::WAIT) {
  v1::Config config = Simulated();
  config.set_temporal_resolution_s(0.1);
  config.mutable_clock()->set_on_silent_simulator(on_silent);
  if (on_silent == v1::Clock::RELEASE) config.mutable_clock()->set_release_after_s(0.5);
  return config;
}

/// One run of one simulator with two agents that touch from 0.4 to 0.6 s after its first clock.
struct Voyage {
  std::string simulator = "alpha";
  std::uint64_t sender = 1;
  std::uint32_t run = 1;
  std::int64_t first_clock_ns = 0;
  bool in_rounds = false;  ///< Its clocks say when its next step is.

  v1::AgentState StateOf(std::uint32_t slot, int step) const {
    const std::int64_t stamp_ns = first_clock_ns + step * kTenth;
    v1::AgentState state = State(slot, stamp_ns, 2 * static_cast<std::uint64_t>(step) + slot + 1);
    const double direction = slot == 0 ? 1 : -1;
    state.mutable_position_m()->set_x(direction * (-5 + step));
    state.mutable_velocity_m_s()->set_x(direction * 10);
    return state;
  }

  std::vector<v1::Input> Told(int step) const {
    std::vector<v1::Input> inputs;
    for (std::uint32_t slot : {0, 1}) {
      if (step == 0) inputs.push_back(From(sender, Description(simulator, slot, run)));
      inputs.push_back(From(sender, StateOf(slot, step), simulator, run));
    }
    v1::SimulatorClock clock = ClockAfter(simulator, first_clock_ns + step * kTenth,
                                          2 * static_cast<std::uint64_t>(step) + 2, 2);
    clock.set_run(run);
    if (in_rounds) clock.set_next_ns(clock.clock_ns() + kTenth);
    inputs.push_back(From(sender, clock));
    return inputs;
  }

  std::vector<v1::Input> Removals() const {
    return {Removal(sender, simulator, 0), Removal(sender, simulator, 1)};
  }
  /// Told(step) by clocks that name this service.
  std::vector<v1::Input> ToldTo(std::uint64_t service, int step) const {
    std::vector<v1::Input> inputs = Told(step);
    for (v1::Input& input : inputs) {
      if (input.has_simulator_clock()) input.mutable_simulator_clock()->set_service_id(service);
    }
    return inputs;
  }

  v1::Input End() const { return Liveliness(sender, simulator, false); }
};

inline std::vector<v1::Input> Joined(std::vector<v1::Input> a, const std::vector<v1::Input>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace collision::server
