// What the service knows about one simulator.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "server/world/agent_table.h"
#include "server/world/contenders.h"
#include "server/world/simulator_time.h"
#include "server/world/standing_refusals.h"
#include "server/world/wall_clock/sender_clock.h"

namespace collision::server {

/// One simulator: its owner (a process), whether that process lives, its time, and its agents.
///
/// The World holds all simulators and decides which process owns each; `time()` and `agents()`
/// guard their own invariants. A higher run starts all of it anew, except the counters, the name,
/// and the marks of clearance samples that are to be published. One thread.
class Simulator {
 public:
  /// `sender`: the network's identity of the process that speaks for it. `id` is the hash of
  /// `name`.
  Simulator(std::uint64_t id, std::uint64_t sender, std::uint32_t run, std::string name)
      : id_(id), sender_(sender), run_(run), name_(std::move(name)) {}

  std::uint64_t id() const { return id_; }
  std::uint64_t sender() const { return sender_; }
  std::uint32_t run() const { return run_; }
  const std::string& name() const { return name_; }

  /// Of the program, as its messages say; 0: none said.
  std::uint32_t incarnation() const { return incarnation_; }
  void SetIncarnation(std::uint32_t incarnation) { incarnation_ = incarnation; }

  /// Starts a run of `sender`. Requires that the agents have been removed. `former`: where the
  /// world's time waits for its first clock, in place of the former run; nullopt: it does not.
  void StartRun(std::uint64_t sender, std::uint32_t run,
                const std::optional<PendingClock>& former = {});

  /// The world's time begins anew, and it is not in it: no agents, no clock, no grant. Requires
  /// that the agents have been removed.
  void LeaveEpoch();

  /// The world's time begins anew, and it stays with its agents and their descriptions: no clock,
  /// no grant. Its clearances are published again. Requires that no agent is admitted.
  void RestartTime();

  /// Its process lives, and the service has not ended its run.
  bool alive() const { return alive_ && !ended_; }
  std::int64_t silent_since_ns() const { return silent_since_ns_; }  ///< Monotonic; if not alive.
  void SetAlive(bool alive, std::int64_t monotonic_ns);

  /// It seems to have ended, and is taken for alive until then (monotonic) all the same.
  void Doubt(std::int64_t until_ns) { doubted_until_ns_ = until_ns; }
  std::optional<std::int64_t> doubted_until_ns() const { return doubted_until_ns_; }

  /// It was silent, or stood, for too long: the world's time does not wait for it until it is alive
  /// again or its clock moves.
  bool released() const { return released_; }
  std::int64_t released_since_ns() const { return released_since_ns_; }  ///< Monotonic; likewise.
  void Release(std::int64_t monotonic_ns);
  void Resume() { released_ = false; }

  /// The service ends this run: no agents, and nothing more is taken of it. Requires that the
  /// agents have been removed.
  void End();

  /// Gone for good: its process or its run has ended, or no step of it follows, and its agents are
  /// removed, or it never described any. A run that follows one which the world waited for, and
  /// ends before it has told an agent, is waited for like that one.
  bool has_left() const { return tells_no_more() && agents_.size() == 0; }

  /// Whether the world's time waits for it. Hypothetical agents that it left behind hold no time.
  bool holds_time() const {
    const bool is_gone = tells_no_more() && agents_.real() == 0;
    return time_.stands_at().has_value() && !released_ && !is_gone;
  }

  detection::AgentId IdOf(std::uint32_t slot, std::uint32_t generation) const {
    return {.simulator = id_, .slot = slot, .run = run_, .generation = generation};
  }

  /// Its newest clock names this service, or none. Whether that clock was refused makes no
  /// difference: it is told so by the service that it has heard.
  bool follows() const { return follows_; }
  void SetFollows(bool follows) { follows_ = follows; }

  /// Taken over from another service, and no clock of it that counts has followed this one since:
  /// it may have been granted more than this service has heard of.
  bool is_inherited() const { return is_inherited_; }
  void EndInheritance() { is_inherited_ = false; }

  /// This service takes over from another one.
  void TakeOver() {
    follows_ = false;
    is_inherited_ = true;
  }

  SenderClock& sender_clock() { return sender_clock_; }
  const SenderClock& sender_clock() const { return sender_clock_; }
  SimulatorTime& time() { return time_; }
  const SimulatorTime& time() const { return time_; }
  AgentTable& agents() { return agents_; }
  const AgentTable& agents() const { return agents_; }
  StandingRefusals& refusals() { return standing_; }
  const StandingRefusals& refusals() const { return standing_; }
  Contenders& contenders() { return contenders_; }
  const Contenders& contenders() const { return contenders_; }

  /// Counts a message that is more than a clock.
  void CountTold() { ++told_; }
  std::uint64_t told() const { return told_; }

  /// Of the newest ScreeningEvent that was told to it; 0: none was.
  std::uint64_t screening_sequence() const { return screening_sequence_; }
  void SetScreeningSequence(std::uint64_t sequence) { screening_sequence_ = sequence; }

  void CountState() { ++states_; }
  std::uint64_t states() const { return states_; }  ///< Accepted, in all runs.

  /// Returns the number of refusals so far, in all runs.
  std::uint64_t CountRefusal() { return ++refused_; }
  std::uint64_t refused() const { return refused_; }

 private:
  /// No step of it follows, or its process or its run has ended.
  bool tells_no_more() const {
    const bool is_awaited = time_.is_awaited() && !released_;
    return time_.has_finished() || (!alive() && !is_awaited);
  }

  const std::uint64_t id_;
  std::uint64_t sender_;
  std::uint32_t run_;
  const std::string name_;
  bool alive_ = true;
  bool released_ = false;
  bool ended_ = false;
  std::int64_t silent_since_ns_ = 0;
  std::optional<std::int64_t> doubted_until_ns_;
  std::int64_t released_since_ns_ = 0;
  std::uint32_t incarnation_ = 0;
  bool follows_ = false;
  bool is_inherited_ = false;
  std::uint64_t screening_sequence_ = 0;
  SenderClock sender_clock_;
  SimulatorTime time_;
  AgentTable agents_;
  StandingRefusals standing_;
  Contenders contenders_;
  std::uint64_t told_ = 0;
  std::uint64_t states_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace collision::server
