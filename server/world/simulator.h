// What the service knows about one simulator.
#pragma once

#include <cstdint>
#include <string>

#include "server/world/agent_table.h"
#include "server/world/sender_clock.h"
#include "server/world/simulator_time.h"

namespace collision::server {

/// One simulator: its owner (a process), whether that process lives, its time, and its agents.
///
/// The World holds all simulators and decides which process owns each; `time()` and `agents()`
/// guard their own invariants. A higher run starts all of it anew, except the counters, the name,
/// and the marks of clearance samples that are to be published. One thread.
class Simulator {
 public:
  /// `sender`: the network's identity of the process that speaks for it.
  Simulator(std::uint64_t id, std::uint64_t sender, std::uint32_t run)
      : id_(id), sender_(sender), run_(run) {}

  std::uint64_t id() const { return id_; }
  std::uint64_t sender() const { return sender_; }
  std::uint32_t run() const { return run_; }
  const std::string& name() const { return name_; }  ///< Empty: not proved yet.

  /// A description or a clock, whose id is the hash of this name, has come from the sender.
  void SetName(const std::string& name) { name_ = name; }

  /// Starts a run of `sender`. Requires that the agents have been removed.
  void StartRun(std::uint64_t sender, std::uint32_t run);

  /// The world's time begins anew, and it is not in it: no agents, no clock, no grant. Requires
  /// that the agents have been removed.
  void LeaveEpoch();

  /// The world's time begins anew, and it stays with its agents and their descriptions: no clock,
  /// no grant. Its clearances are published again. Requires that no agent is admitted.
  void RestartTime();

  bool alive() const { return alive_; }
  std::int64_t silent_since_ns() const { return silent_since_ns_; }  ///< Monotonic; if not alive.
  void SetAlive(bool alive, std::int64_t monotonic_ns);

  /// It was silent for too long: the world's time does not wait for it until it is alive again.
  bool released() const { return released_; }
  void Release() { released_ = true; }

  /// All its input so far is what it had written while it waited for the id.
  bool succeeded_unheard() const { return succeeded_unheard_; }
  void SetSucceededUnheard(bool unheard) { succeeded_unheard_ = unheard; }

  /// Gone for good: its process has ended, and it removed all its agents or never described any.
  bool has_left() const { return !alive_ && agents_.size() == 0; }

  /// Whether the world's time waits for it.
  bool holds_time() const { return time_.clock().has_value() && !released_ && !has_left(); }

  detection::AgentId IdOf(std::uint32_t slot, std::uint32_t generation) const {
    return {.simulator = id_, .slot = slot, .run = run_, .generation = generation};
  }

  SenderClock& sender_clock() { return sender_clock_; }
  const SenderClock& sender_clock() const { return sender_clock_; }
  SimulatorTime& time() { return time_; }
  const SimulatorTime& time() const { return time_; }
  AgentTable& agents() { return agents_; }
  const AgentTable& agents() const { return agents_; }

  void CountState() { ++states_; }
  std::uint64_t states() const { return states_; }  ///< Accepted, in all runs.

  /// Returns the number of refusals so far, in all runs.
  std::uint64_t CountRefusal() { return ++refusals_; }
  std::uint64_t refusals() const { return refusals_; }

 private:
  const std::uint64_t id_;
  std::uint64_t sender_;
  std::uint32_t run_;
  std::string name_;
  bool alive_ = true;
  bool released_ = false;
  std::int64_t silent_since_ns_ = 0;
  bool succeeded_unheard_ = false;
  SenderClock sender_clock_;
  SimulatorTime time_;
  AgentTable agents_;
  std::uint64_t states_ = 0;
  std::uint64_t refusals_ = 0;
};

}  // namespace collision::server
