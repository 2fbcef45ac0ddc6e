// The simulators that a service before this one served, as far as they have not come back.
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

/// Whom a restarted service waits for (simulated clock). The time of the world does not go on
/// before each simulator of the roster has a clock in force, under its run or a higher one, or is
/// given up. Otherwise those that are there would be granted time past contacts with one that is
/// out of reach for the moment. Pure bookkeeping. One thread.
class Roster {
 public:
  explicit Roster(const std::vector<JournalledSimulator>& entries);

  /// The simulator has a clock in force in this run.
  void Arrive(std::uint64_t id, std::uint32_t run);

  /// Nobody waits for it any more. False: it is not missing.
  bool GiveUp(const std::string& name);

  /// Nobody waits any more. Returns the names of those that were missing.
  std::vector<std::string> GiveUpAll();

  bool complete() const { return missing_.empty(); }
  std::vector<std::string> missing() const;  ///< Names.
  const std::map<std::uint64_t, JournalledSimulator>& entries() const { return missing_; }
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
  std::map<std::uint64_t, JournalledSimulator> missing_;  ///< By id.
  Instant greatest_grant_ = Instant::Always();
};

}  // namespace collision::server
