// The daemon, its network and its simulators, all in the test's own process and virtual time.
#pragma once

#include <memory>
#include <vector>

#include "server/config/config.h"
#include "server/recording/flight_recorder.h"
#include "server/recording/recording.h"
#include "server/service/daemon.h"
#include "tests/simulation/simulated_network.h"
#include "tests/simulation/simulated_simulator.h"

namespace collision::server {

inline constexpr std::int64_t kSecond = 1'000'000'000;

/// The default configuration with a simulated clock that waits for `simulators`.
v1::Config ConfigFor(std::size_t simulators);

/// Loses, repeats and reorders.
NetworkOptions Lossy(std::uint64_t seed);

/// Balls that wander. Every third comes late or leaves early; every other knows its position to 30
/// cm only, so that what grazes stays undecided.
std::vector<SimulatedAgent> Crowd(int count, std::int64_t end_ns, Random* random);

/// Everything of one run. Simulators are added, then Run() goes on until nothing can happen any
/// more.
class Scenario {
 public:
  Scenario(const v1::Config& config, const NetworkOptions& network);

  SimulatedSimulator& Add(const SimulatorOptions& options, std::vector<SimulatedAgent> agents);

  /// A new daemon with an empty memory, in place of the one before. Without a `shape_builder` it
  /// has its own.
  void StartService(BatchSink* recorder = nullptr,
                    std::unique_ptr<ShapeBuilder> shape_builder = nullptr,
                    FlightSink* flight = nullptr);

  /// Lets all simulators write their first samples.
  void StartSimulators();

  /// Steps until nothing is left to happen, or the virtual time has come.
  void Run(std::int64_t until_ns = std::numeric_limits<std::int64_t>::max());

  SimulatedNetwork& network() { return network_; }
  Daemon& daemon() { return *daemon_; }

  /// Outputs of all services so far.
  std::vector<v1::Output> published() const;
  std::vector<v1::CollisionEvent> events() const;

  /// The newest status; it must exist.
  v1::ServiceStatus status() const;
  std::uint64_t counter(const std::string& name) const;

  std::vector<const SimulatedSimulator*> simulators() const;

 private:
  const v1::Config config_;
  SimulatedNetwork network_;
  SimulatedClock clock_;
  std::vector<std::unique_ptr<SimulatedSimulator>> simulators_;
  std::vector<v1::Output> earlier_;
  std::unique_ptr<SimulatedBus> bus_;
  std::unique_ptr<Daemon> daemon_;
};

/// Two simulators, alpha and beta, with a Crowd() of 16 each; beta tells its states in chunks.
void AddCrowds(std::int64_t end_ns, Scenario* scenario);

}  // namespace collision::server
