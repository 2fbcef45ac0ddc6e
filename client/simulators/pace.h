// How a simulator's clock moves: as the service grants, or with the wall clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "client/world.h"

namespace collision::client {

/// What every simulator's command line says about its connection.
struct SimulatorOptions {
  std::string world = "default";
  std::string simulator;
  std::uint32_t domain = 0;
  bool real_time = false;      ///< Wall-clock stamps; otherwise lock-step.
  std::int64_t start_ns = -1;  ///< Wall clock: the run's start since 1970; -1: now.
  double speed = 0;     ///< Lock-step: at most this many simulated seconds a second; 0: as granted.
  double seconds = 0;   ///< Length of the run.
  bool linger = false;  ///< At the end wait for SIGTERM, so that the service can judge everything.
  std::string motion_log;
};

class Pace {
 public:
  /// Connects and waits for the service, 20 s at most. Throws std::runtime_error.
  explicit Pace(const SimulatorOptions& options);

  World& world() { return world_; }

  /// The run's start: 0 in lock-step.
  std::int64_t start_ns() const { return start_ns_; }

  /// The run's end.
  std::int64_t end_ns() const;

  /// Publishes what was set for instants up to `clock_ns` and moves the clock there; events come
  /// meanwhile. False: asked to stop. Throws std::runtime_error if the service grants nothing for
  /// 30 s.
  bool AdvanceTo(std::int64_t clock_ns);

  /// With `linger` waits, receiving, until asked to stop.
  void Linger();

 private:
  bool WaitForWall(std::chrono::steady_clock::time_point until);

  SimulatorOptions options_;
  World world_;
  std::int64_t start_ns_ = 0;
  std::chrono::steady_clock::time_point start_;  // the same moment
};

}  // namespace collision::client
