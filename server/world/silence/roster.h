// The simulators that the world's time waits for until they tell a clock.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/base/instant.h"
#include "server/claim/journalled_simulator.h"

namespace collision::server {

/// Of a simulator that the world's time waits for.
struct Missing {
  std::uint32_t run = 0;
  std::string name;
  /// Since when it is waited for, monotonic; nullopt: since the service's first step.
  std::optional<std::int64_t> since_ns = {};
  /// It was in this world's time, and another program has taken over its name.
  bool started_again = false;
};

/// Whom a restarted service waits for (simulated clock), and a service whose simulator has started
/// again. The time of the world does not go on before each simulator of the roster has a clock in
/// force, under its run or a higher one, or is given up. Otherwise those that are there would be
/// granted time past contacts with one that is out of reach for the moment. Pure bookkeeping. One
/// thread.
class Roster {
 public:
  /// Those that the service before this one served.
  explicit Roster(const std::vector<JournalledSimulator>& entries);

  /// From here on it is waited for; since before, if it is missing already.
  void Await(std::uint64_t id, Missing missing);

  /// The simulator has a clock in force in this run.
  void Arrive(std::uint64_t id, std::uint32_t run);

  /// Nobody waits for it any more. False: it is not missing.
  bool GiveUp(const std::string& name);

  /// Likewise for those that have been waited for since this time or longer; `begun_ns`: the
  /// service's first step. Returns the names of those that were missing.
  std::vector<std::string> GiveUpSince(std::int64_t since_ns, std::int64_t begun_ns);

  /// Nobody waits any more.
  void GiveUpAll() { missing_.clear(); }

  bool complete() const { return missing_.empty(); }
  bool AwaitsNewRun() const;                 ///< Of one that has started again.
  std::vector<std::string> missing() const;  ///< Names.
  const std::map<std::uint64_t, Missing>& entries() const { return missing_; }
  bool IsMissing(std::uint64_t id) const { return missing_.contains(id); }

  /// Why a message of this run is refused, with the allowed range; nullopt: it is not. A run lower
  /// than the one that was served before is of another program, or of a host whose clock is behind.
  std::optional<std::string> Refusal(std::uint64_t id, std::uint32_t run) const;

  /// The greatest time granted to any of them; Always() if there was none.
  Instant greatest_grant() const { return greatest_grant_; }

  /// So much may have been granted.
  void RaiseGrant(Instant granted) { greatest_grant_ = std::max(greatest_grant_, granted); }

  /// That time is over: the grants of before mean nothing any more.
  void Forget();

 private:
  std::map<std::uint64_t, Missing> missing_;  ///< By id.
  Instant greatest_grant_ = Instant::Always();
};

}  // namespace collision::server
