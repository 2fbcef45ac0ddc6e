// Who is in the world, who owns what, and what time it is. Pure bookkeeping: no bus, no core, no
// log.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "server/clock.h"
#include "server/codec.h"
#include "server/simulator.h"

namespace collision::server {

/// Whether a sender may speak for a simulator id.
struct Claim {
  Simulator* simulator = nullptr;  ///< The one the id names; null if there is none and no room.
  bool accepted = false;
  bool new_run = false;   ///< Accepted, and everything of the former run must go first: StartRun().
  bool may_wait = false;  ///< Refused only while the owner lives: a higher run of another sender.
  v1::RejectionReason reason = v1::REJECTED_ID_OWNED;  ///< Unless accepted.
  std::string detail = {};
};

/// The simulators and the world's time. One thread.
///
/// Simulated clock: now is the least clock of those who hold time, once `simulators_awaited` have
/// told one; it never goes back. Wall clock: the wall reading at the start, carried on by the
/// monotonic clock.
class World {
 public:
  explicit World(const v1::Config& config);

  /// `name`: as told in a description or clock, already checked against the id; null for messages
  /// without. Only a named message proves ownership: it takes an id from a sender that never named
  /// itself.
  Claim ClaimFor(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                 const std::string* name);

  Simulator* Find(std::uint64_t id);
  std::map<std::uint64_t, Simulator>& simulators() { return simulators_; }
  const std::map<std::uint64_t, Simulator>& simulators() const { return simulators_; }

  /// The daemon's clocks at this step. With a wall clock this moves `now`.
  void SetReading(const ClockReading& reading);

  /// Simulated clock: brings `now` to the least clock. Call after the clocks of a batch are in
  /// force.
  void UpdateSimulatedTime();

  /// Simulated clock: who has been silent for `release_after_s` no longer holds time. Returns the
  /// names of those released now.
  std::vector<std::string> ReleaseSilent();

  /// Simulated clock: the names of those whose process has gone and who hold time all the same.
  std::vector<std::string> WaitedFor() const;

  bool simulated() const { return simulated_; }
  /// Nothing happens before: there is no `now` yet.
  bool started() const { return started_; }
  Instant now() const { return now_; }
  std::int64_t monotonic_ns() const { return reading_.monotonic_ns; }

  /// Brings a simulator's clock into force as far as what was written before it has arrived. False:
  /// no change.
  bool TakeClock(Simulator* simulator);

  StampRules RulesForState(const Simulator& simulator, bool admitted) const;
  ClockRules RulesForClock(const Simulator& simulator) const;

  /// From when on a change counts that may lower promises already given.
  Instant EffectiveFrom(Instant stamp) const;

  /// Grants each simulator with a clock as much time as is certainly free, and Δt at least; marks
  /// chunk 0 of those whose grant grew. Nothing granted is ever withdrawn.
  void UpdateGrants();

  /// The monotonic time at which ReleaseSilent() may next find somebody; nullopt: nobody is silent.
  std::optional<std::int64_t> NextRelease() const;

 private:
  Simulator* MakeRoomFor(std::uint64_t id);
  Instant LatestAllowed(const Simulator& simulator) const;

  const bool simulated_;
  const bool releases_silent_;
  const double skew_;
  const double grant_ahead_max_;
  const double temporal_resolution_;
  const std::int64_t release_after_ns_;
  const std::size_t simulators_awaited_;
  const std::size_t simulators_max_;

  std::map<std::uint64_t, Simulator> simulators_;
  bool started_ = false;
  Instant now_;
  ClockReading reading_;
  std::optional<std::int64_t> wall_minus_monotonic_ns_;
};

/// Seconds of a configuration, as nanoseconds.
std::int64_t ToNanoseconds(double seconds);

}  // namespace collision::server
