// The simulators of the world, which process speaks for each of them, and what time it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "server/bus/clock.h"
#include "server/codec/codec.h"
#include "server/world/simulator.h"
#include "server/world/succession.h"
#include "server/world/wall_time.h"

namespace collision::server {

/// Whether a sender may speak for a simulator id.
struct Claim {
  Simulator* simulator = nullptr;  ///< The one that the id names; null: unknown, and no room.
  bool accepted = false;
  bool new_run = false;  ///< Accepted, and a run begins: remove its agents, then StartRun().
  /// Refused only because the owner lives: another sender with a higher run.
  bool may_wait = false;
  v1::RejectionReason reason = v1::REJECTED_ID_OWNED;  ///< Unless accepted.
  std::string detail = {};
};

/// The owner of all simulators, and the world's time. Pure bookkeeping: no bus, no detector, no
/// log. One thread.
///
/// **Ownership.** An id belongs to the first sender that names itself, in a description or a clock;
/// states alone prove nothing. Another sender is refused until the owner is gone *and* the other
/// one's run is higher. A successor that writes earlier is refused, and what it writes is held
/// (Succession). A simulator has left when its process is gone and it has no agents; it makes room
/// for another one.
///
/// **Now.** Simulated clock: the least clock in force of the simulators that hold time, once
/// `simulators_awaited` have one. It never goes back. A silent simulator holds time for ever
/// (WAIT) or for `release_after_s` (RELEASE); its agents stay, and their bounds grow. Wall clock:
/// what it shows (WallTime).
///
/// **Epochs** (simulated clock). When nobody holds time any more, the epoch is over: agents that
/// were left behind are gone, and the next simulator's first clock begins another one, at whatever
/// time it names up to `first_clock_max_s`. A dead simulator whose successor waits holds no time
/// here. Wall clock: a step of it that breaks the time begins another epoch at once; simulators and
/// the descriptions of their agents stay.
///
/// **Grants** (simulated clock). A simulator may run until the least `clear_until` of its agents,
/// at least to now + `temporal_resolution_s`, at most to now + `grant_ahead_max_s`; a grant is
/// never withdrawn. A simulator whose first clock is not the start of a run was granted time by a
/// service before this one: it is believed up to that clock + `grant_ahead_max_s`. Before its
/// first grant a simulator may be ahead of now, or of its first clock, by `grant_ahead_max_s`.
class World {
 public:
  explicit World(const v1::Config& config);

  /// `name`: as in a description or clock, already checked against the id; null for messages
  /// without one. Only a named message proves ownership: it takes an id from a sender that never
  /// named itself.
  Claim ClaimFor(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                 const std::string* name);

  /// Null: unknown.
  Simulator* Find(std::uint64_t id);
  std::map<std::uint64_t, Simulator>& simulators() { return simulators_; }
  const std::map<std::uint64_t, Simulator>& simulators() const { return simulators_; }

  Succession& succession() { return succession_; }

  /// The daemon's clocks at this step. With a wall clock this moves `now`, and returns the step of
  /// the clock, if it was set. One that breaks the time needs BeginEpoch().
  std::optional<ClockStep> SetReading(const ClockReading& reading);

  /// Simulated clock: brings `now` to the least clock. Call it after the clocks of a batch are in
  /// force.
  void UpdateSimulatedTime();

  /// Simulated clock: simulators that have been silent for `release_after_s` hold time no longer.
  /// Returns the names of those released now.
  std::vector<std::string> ReleaseSilent();

  /// Simulated clock: the names of the simulators whose process is gone and that still hold time.
  std::vector<std::string> WaitedFor() const;

  /// Simulated clock: it has begun, and nobody holds time any more. Call it before successors take
  /// over.
  bool EpochIsOver() const;

  /// Brings `now` to the greatest clock in force: all that was told of this epoch counts.
  void FinishEpoch();

  /// Simulated clock: there is no `now` until the next first clock. Requires that the agents of the
  /// simulators that leave (LeavesWithEpoch()) have been removed. Wall clock: now is what the clock
  /// shows. Requires that no agent is admitted.
  void BeginEpoch();

  /// Whether it was in the epoch that is over. Who has no clock yet comes to the next one.
  static bool LeavesWithEpoch(const Simulator& simulator) {
    return simulator.time().clock().has_value() || !simulator.alive();
  }

  std::uint32_t epoch() const { return epoch_; }  ///< From 1.

  bool simulated() const { return simulated_; }
  bool started() const { return started_; }  ///< There is a `now`; nothing happens before.
  Instant now() const { return now_; }
  std::int64_t monotonic_ns() const { return reading_.monotonic_ns; }

  /// What a clock tells of its sender's offset; nullopt: nothing. `service_id`: of this service.
  std::optional<RoundTrip> RoundTripOf(const v1::SimulatorClock& clock,
                                       std::uint64_t service_id) const;

  StampRules RulesForState(const Simulator& simulator, bool admitted) const;
  ClockRules RulesForClock(const Simulator& simulator) const;

  /// From when on a change counts that may lower promises already given: with a simulated clock the
  /// greatest time granted to any simulator.
  Instant EffectiveFrom(Instant stamp) const;

  /// The detector gives an agent a new clearance. Ignored if the agent is not there any more.
  void SetClearance(const detection::AgentClearance& clearance);

  /// Grants each simulator with a clock the time described above, and marks its clearance samples
  /// where the grant has grown.
  void UpdateGrants();

  /// The monotonic time at which ReleaseSilent() may next release a simulator; nullopt: none is
  /// silent.
  std::optional<std::int64_t> NextRelease() const;

  /// Walks all simulators and checks what must hold, with CORE_CHECK. For tests and debug builds.
  void Validate() const;

 private:
  Simulator* Add(std::uint64_t id, std::uint64_t sender, std::uint32_t run);
  Instant LatestAllowed(const Simulator& simulator) const;
  void BeginWallEpoch();

  const bool simulated_;
  const bool releases_silent_;
  const double skew_;
  const double grant_ahead_max_;
  const double temporal_resolution_;
  const Instant first_clock_max_;
  const std::int64_t release_after_ns_;
  const std::size_t simulators_awaited_;
  const std::size_t simulators_max_;

  std::map<std::uint64_t, Simulator> simulators_;
  Succession succession_;
  std::uint32_t epoch_ = 1;
  bool started_ = false;
  Instant now_;
  ClockReading reading_;
  WallTime wall_time_;
};

/// Seconds of a configuration, as nanoseconds.
std::int64_t ToNanoseconds(double seconds);

}  // namespace collision::server
