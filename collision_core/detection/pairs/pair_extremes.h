// What an agent's pairs say of it together.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/base/instant.h"

namespace collision::detection {

/// The extremes over some tracked pairs; of no pair by default.
struct PairExtremes {
  Instant clear_until = Instant::Never();        ///< Least of those that are not in contact.
  Instant unannounced_until = Instant::Never();  ///< Least clear_until of those not announced.
  Instant needed_from = Instant::Never();        ///< Least time from which states are needed.
  Instant unsettled_until = Instant::Always();   ///< Greatest.
  std::uint32_t contacts = 0;                    ///< Pairs in contact.

  friend bool operator==(const PairExtremes&, const PairExtremes&) = default;
};

/// Keeps the extremes of each agent's pairs, exactly, without a walk over all of them whenever one
/// changes: only when a pair that was an extreme has moved away from it are the agent's pairs
/// visited, at most once until the next change. Single-threaded, also where it is const.
class AgentExtremes {
 public:
  /// The agent of this index has no pairs yet.
  void AddAgent(AgentIndex agent);

  /// What the pair in this slot says of its two agents; PairExtremes() as long as, and as soon as,
  /// it is not tracked. O(1). Requires AddAgent() for both, which stay the same until then.
  void Set(PairSlot slot, AgentIndex a, AgentIndex b, const PairExtremes& pair);
  const PairExtremes& OfPair(PairSlot slot) const { return pairs_.at(slot); }

  /// The extremes over `slots`, all tracked pairs of the agent. O(1), or O(slots): see above.
  const PairExtremes& Of(AgentIndex agent, const std::vector<PairSlot>& slots) const;

  /// Walks the agent's pairs: what is kept are their extremes, or is known to be outdated.
  void Validate(AgentIndex agent, const std::vector<PairSlot>& slots) const;

 private:
  struct Extremes {
    PairExtremes of_pairs;
    bool outdated = false;  // the pair that was an extreme is so no longer
  };

  PairExtremes Over(const std::vector<PairSlot>& slots) const;

  IndexedVector<PairSlot, PairExtremes> pairs_;
  mutable IndexedVector<AgentIndex, Extremes> agents_;
};

}  // namespace collision::detection
