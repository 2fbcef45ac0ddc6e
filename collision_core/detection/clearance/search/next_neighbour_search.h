// The next intersection of an agent, however far ahead.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/neighbour_index.h"
#include "collision_core/detection/clearance/search/clearance_query.h"
#include "collision_core/detection/clearance/search/query_horizons.h"

namespace collision::detection {

/// Finds the next intersection with the broad phase, horizon by horizon. Far ahead a whole swarm
/// may come near at about the same time: then one partner in 32 is queried first, and the earliest
/// of these answers spares nearly all other pair queries.
class NextNeighbourSearch {
 public:
  /// All outlive the search. `broad_phase` holds the wide bounds of all agents.
  NextNeighbourSearch(broad_phase::NeighbourIndex* broad_phase, const AccelerationTiers& tiers,
                      const StepClock& clock)
      : broad_phase_(broad_phase), tiers_(tiers), horizons_(clock) {}

  const QueryHorizons& horizons() const { return horizons_; }
  /// The horizon with which the search begins.
  int Begin(const ClearanceQuery& query) const {
    return horizons_.Begin(tiers_.TierOf(query.agent), query.band);
  }
  /// The answer was found by other means: adapts the horizons to it.
  void Record(const ClearanceQuery& query, Instant when) {
    horizons_.Record(tiers_.TierOf(query.agent), query.band, when);
  }

  /// The first intersection with a partner that is not left out. Unchecked: there is none by
  /// `known`.
  NextNeighbour Find(const ClearanceQuery& query, Instant known);

  /// The earliest of `neighbours` whose partner is not tracked.
  static NextNeighbour EarliestOf(const std::vector<broad_phase::Neighbour>& neighbours,
                                  const PartnerMarks& tracked);

  /// Partners examined besides the broad phase's own tests, since the start.
  std::uint64_t examined() const { return examined_; }

 private:
  void FindUpTo(const ClearanceQuery& query, Instant known, Instant horizon);

  broad_phase::NeighbourIndex* broad_phase_;
  const AccelerationTiers& tiers_;
  QueryHorizons horizons_;
  std::uint64_t examined_ = 0;
  std::vector<broad_phase::Neighbour> found_;  // scratch of one query, kept for its memory
};

}  // namespace collision::detection
