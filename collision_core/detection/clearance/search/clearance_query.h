// A query about the clearance of one agent.
#pragma once

#include <cstdint>

#include "collision_core/base/ids.h"
#include "collision_core/base/instant.h"
#include "collision_core/detection/clearance/keys/acceleration_tiers.h"
#include "collision_core/detection/pairs/pair_table.h"

namespace collision::detection {

/// A set of partners of one agent, emptied in O(1); kept for its memory from one query to the
/// next.
class PartnerMarks {
 public:
  /// Replaces the set by the agent itself and the partners that it is tracked with. `agents` is one
  /// more than the greatest index.
  void Start(AgentIndex agent, const PairTable& pairs, std::size_t agents) {
    ++mark_;
    if (marks_.size() < agents) marks_.resize(agents, 0);
    for (const PairSlot slot : pairs.Of(agent)) {
      marks_.at(pairs[slot].lower) = marks_.at(pairs[slot].higher) = mark_;
    }
  }
  void Add(AgentIndex partner) { marks_.at(partner) = mark_; }
  /// False for an index beyond those that were there at Start().
  bool Contains(AgentIndex partner) const {
    return marks_.contains(partner) && marks_[partner] == mark_;
  }

 private:
  IndexedVector<AgentIndex, std::uint64_t> marks_;
  std::uint64_t mark_ = 0;
};

/// The band of a query about all partners; the other bands are those of
/// AccelerationTiers::BandOf().
inline constexpr int kEveryBand = -1;

/// Which partners, of those not left out, may `agent` meet at or after `from`? Everything that the
/// answer depends on, besides the bounds themselves.
struct ClearanceQuery {
  AgentIndex agent;
  int band = kEveryBand;
  Instant from;     ///< min(now, covered)
  Instant covered;  ///< Up to here the agent is certified clear of the band's untracked partners.
  bool renewed = false;        ///< Promises made from `covered` on are void.
  bool was_saturated = false;  ///< Nothing was promised up to now.
  /// The tracked partners, which are left out; those that become tracked are added.
  PartnerMarks* tracked = nullptr;

  /// Whether the query does not ask about this partner: it is tracked, or of another band.
  bool LeavesOut(AgentIndex partner, const AccelerationTiers& tiers) const {
    if (tracked->Contains(partner)) return true;
    return band != kEveryBand && tiers.BandOf(partner, agent) != band;
  }
};

/// The first intersection with a partner that is not tracked.
struct NextNeighbour {
  Instant when = Instant::Never();  ///< Never(): none.
  AgentIndex partner;
};

}  // namespace collision::detection
