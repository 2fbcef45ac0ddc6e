// The clock of a simulator: it moves as the service grants time, or with the wall clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "collision/world.h"

namespace collision::client {

/// The options of the connection, which all simulators share.
struct SimulatorOptions {
  std::string world = "default";
  std::string simulator;
  std::uint32_t domain = 0;
  std::string credentials;     ///< Folder; empty: none.
  bool real_time = false;      ///< Wall-clock stamps; otherwise lock-step.
  std::int64_t start_ns = -1;  ///< In real time: the run's start since 1970; -1: now.
  double speed = 0;     ///< Lock-step: at most this many simulated seconds a second; 0: no limit.
  double seconds = 0;   ///< Length of the run.
  bool linger = false;  ///< At the end wait for SIGTERM, so that the service can decide everything.
  bool stream = false;  ///< Send every state, not only those that the service needs.
  std::string motion_log;
  std::string traffic;  ///< File for the numbers of states set and sent; empty: none.
  bool quiet = false;   ///< Do not print where it looks for the service.
};

/// One step of a simulator's loop.
struct PaceStep {
  std::int64_t t0_ns = 0;
  std::int64_t t1_ns = 0;
  bool with_states = false;  ///< The states at t1 are to be set.
};

class Pace {
 public:
  /// Connects, prints where, and waits for the service, at most 20 s. Throws std::runtime_error.
  explicit Pace(const SimulatorOptions& options);
  Pace(const Pace&) = delete;
  Pace& operator=(const Pace&) = delete;

  World& world() { return world_; }

  /// The run's start: 0 in lock-step.
  std::int64_t start_ns() const { return start_ns_; }

  /// The run's end.
  std::int64_t end_ns() const;

  /// Publishes the states with stamps up to `clock_ns` and moves the clock there; delivers events
  /// meanwhile. False: the program was asked to stop. Throws std::runtime_error
  /// if the service grants no time for 120 s and names nobody whom it waits for; RefusedError if it
  /// refused the agents, if an operator ended the run, or if its clock is of the other kind.
  bool AdvanceTo(std::int64_t clock_ns);

  /// The loop of a simulator that steps `rate_hz` times a second. `step` computes the motion from
  /// t0 to t1 and, if `with_states` (at every `state_every`-th step and at the end), sets the
  /// states at t1. Returns at the end of the run, when `step` returns false, or when the program is
  /// asked to stop.
  void Fly(double rate_hz, std::size_t state_every,
           const std::function<bool(const PaceStep&)>& step);

  /// With SimulatorOptions::linger keeps receiving until the program is asked to stop.
  void Linger();

  /// At the end: prints how many states were set and sent, unless `quiet`, and writes the file.
  void ReportTraffic(bool quiet = false) const;

  /// At the end: prints how many samples were refused. Throws RefusedError if the agents were.
  void CheckRefusals();

 private:
  bool WaitForWall(std::chrono::steady_clock::time_point until);
  /// Whether the service is there and says for whom or what else time waits.
  bool HasReason() const;
  void TakeRefusals();
  void Hear(const Notice& notice) const;
  void RequireAgentsTaken() const;

  SimulatorOptions options_;
  World world_;
  std::vector<std::string> waited_for_;  ///< As the service last said.
  bool has_service_ = true;
  std::uint64_t refused_ = 0;     ///< As the service counts.
  std::string refused_for_good_;  ///< The first reason.
  std::int64_t start_ns_ = 0;
  std::chrono::steady_clock::time_point start_;  // the same moment
};

}  // namespace collision::client
