// One run: the network, and all programs on it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/faults/judge.h"
#include "tests/support/suite/case.h"

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
};

/// Three simulators, alpha, beta and gamma, with different steps; gamma streams every state.
struct Fleet {
  v1::Config config = LockStepConfig(3);
  NetworkOptions network;
  std::uint64_t seed = 1;
  int agents = 6;  ///< Of each.
  std::int64_t end_ns = 10 * kSecond;
  bool lock_step = true;
  std::vector<std::int64_t> wall_offsets_ns = {0, 0, 0};
  bool keeps_journal = false;
  std::int64_t limit_ns = 600 * kSecond;  ///< Virtual time in which the run must come to its end.
};

/// All of them on one network with a service and a monitor, not yet started.
std::unique_ptr<Scene> MakeScene(const Fleet& fleet);

/// Starts them, lets `faults` arrange what is to happen, and runs to the end, which is expected.
void Fly(const Fleet& fleet, Scene* scene, const std::function<void()>& faults,
         suite::Outcome* outcome);

/// What the events of a lock-step run are known by.
struct Fingerprint {
  std::uint64_t hash = 0, count = 0;
  bool operator==(const Fingerprint&) const = default;
};
/// Of the same fleet on a perfect network, without any fault.
Fingerprint PerfectEvents(const Fleet& fleet);

/// Puts a judgement into the outcome: what must hold is checked, what was seen is counted.
void Report(const Judgement& judgement, std::uint64_t seed, suite::Outcome* outcome);

/// What the network did.
void Report(const NetworkCounters& counters, suite::Outcome* outcome);

/// Every contact that the services published was heard, once and in order, and none counts as
/// missed.
void ExpectAllHeard(const MonitorProgram& monitor, std::uint64_t seed, suite::Outcome* outcome);

}  // namespace collision::faults
