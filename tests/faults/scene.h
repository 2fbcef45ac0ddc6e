// One run: the network, and all programs on it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/faults/heap.h"
#include "tests/faults/judge.h"

namespace collision::faults {

/// A simulated clock that waits for so many simulators; and a wall clock.
v1::Config LockStepConfig(std::size_t simulators);
v1::Config WallConfig(double skew_max_s);

/// Loses, delays, doubles.
NetworkOptions Perfect(std::uint64_t seed);
NetworkOptions Faulty(std::uint64_t seed);

/// Balls that wander in a cube so small that they meet.
std::vector<Flight> Wanderers(int count, std::int64_t end_ns, Random* random);

class Scene {
 public:
  Scene(const v1::Config& config, const NetworkOptions& network);
  ~Scene();

  ServiceProgram& AddService(const ServiceOptions& options = {.state_dir = {}});
  SimulatorProgram& AddSimulator(const SimulatorOptions& options, std::vector<Flight> flights);
  MonitorProgram& AddMonitor();
  /// A folder of its own, removed with the scene.
  std::string StateDir();

  void StartAll();
  /// Until all simulators that live have finished, and a time longer; at most until `limit_ns`.
  /// False: they have not.
  bool RunToEnd(std::int64_t limit_ns);

  Network& network() { return network_; }
  /// Of the programs of this scene together.
  HeapUse heap(Owner owner) const;
  const v1::Config& config() const { return config_; }
  const Network& network() const { return network_; }
  const ServiceProgram& service(std::size_t i = 0) const { return *services_[i]; }
  const MonitorProgram& monitor(std::size_t i) const { return *monitors_[i]; }
  std::size_t services() const { return services_.size(); }
  std::size_t monitors() const { return monitors_.size(); }
  ServiceProgram& service(std::size_t i = 0) { return *services_[i]; }
  SimulatorProgram& simulator(std::size_t i) { return *simulators_[i]; }
  MonitorProgram& monitor(std::size_t i = 0) { return *monitors_[i]; }
  std::vector<const SimulatorProgram*> simulators() const;
  /// The least step that a simulator which still flies has reached, less the base.
  std::int64_t reached_ns() const;
  /// Once all have reached this step.
  void When(std::int64_t reached_ns, std::function<void()> action);

  Judgement Judged(const JudgeOptions& options = {}, std::size_t monitor = 0) const;

 private:
  const v1::Config config_;
  Network network_;
  std::vector<std::unique_ptr<ServiceProgram>> services_;
  std::vector<std::unique_ptr<SimulatorProgram>> simulators_;
  std::vector<std::unique_ptr<MonitorProgram>> monitors_;
  std::string state_dir_;
  std::array<std::int64_t, kOwners> before_{};  ///< Live bytes of each owner.
};

}  // namespace collision::faults
