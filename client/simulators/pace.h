// How a simulator's clock moves: as the service grants, or with the wall clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "client/simulators/refusals.h"
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
  bool stream = false;  ///< Every state is sent, not only those that the service needs.
  std::string motion_log;
  std::string traffic;  ///< File for what was set and sent; empty: none.
};

class Pace {
 public:
  /// Connects and waits for the service, 20 s at most; says so if it takes longer. Throws
  /// std::runtime_error.
  explicit Pace(const SimulatorOptions& options);

  World& world() { return world_; }

  /// The run's start: 0 in lock-step.
  std::int64_t start_ns() const { return start_ns_; }

  /// The run's end.
  std::int64_t end_ns() const;

  /// Publishes what was set for instants up to `clock_ns` and moves the clock there; events come
  /// meanwhile, refusals are printed. False: asked to stop. Throws std::runtime_error if the service
  /// grants nothing for 30 s, RefusedError if that is because it refused the agents, or if its
  /// clock is of the other kind.
  bool AdvanceTo(std::int64_t clock_ns);

  /// The loop of a simulator that steps `rate_hz` times a second: `step(t0, t1, told)` computes the
  /// motion from t0 to t1 and, where `told`, sets the states at t1: at every `state_every`-th step and
  /// at the end. Ends there, or when `step` returns false or the program is asked to stop.
  void Fly(double rate_hz, std::size_t state_every,
           const std::function<bool(std::int64_t, std::int64_t, bool)>& step);

  /// With `linger` waits, receiving, until asked to stop.
  void Linger();

  /// At the end: what was set and sent, as a line, unless `quiet`, and into the file for it.
  void ReportTraffic(bool quiet = false) const;

  /// At the end: prints how much was refused. Throws RefusedError if that were the agents.
  void CheckRefusals();

 private:
  bool WaitForWall(std::chrono::steady_clock::time_point until);
  void HearRefusals();
  void RequireClock() const;
  void RequireAgentsTaken() const;

  SimulatorOptions options_;
  World world_;
  Refusals refusals_;
  std::int64_t granted_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t start_ns_ = 0;
  std::chrono::steady_clock::time_point start_;  // the same moment
};

}  // namespace collision::client
