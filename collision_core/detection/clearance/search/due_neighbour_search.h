// The partners of an agent that must be tracked now.
#pragma once

#include <vector>

#include "collision_core/broad_phase/neighbour_index.h"
#include "collision_core/detection/clearance/search/clearance_query.h"
#include "collision_core/detection/pairs/pair_table.h"
#include "collision_core/detection/step/step_clock.h"

namespace collision::detection {

/// Finds the partners that an agent may meet by announce_until, as far as there is room for them.
/// If more partners qualify than fit, the agent is saturated: it takes those with the lowest
/// indices and leaves out partners that are full. The result does not depend on the order in which
/// the broad phase offers partners, and the search makes no pair query that it does not need.
class DueNeighbourSearch {
 public:
  /// All outlive the search.
  DueNeighbourSearch(broad_phase::NeighbourIndex* broad_phase, const AccelerationTiers& tiers,
                     const PairTable& pairs, const StepClock& clock)
      : broad_phase_(broad_phase), tiers_(tiers), pairs_(pairs), clock_(clock) {}

  /// Replaces *found by the intersections by announce_until, and the earliest of the others up to
  /// `horizon`, in the order of partners. Returns the first partner for which there is no room:
  /// None() if the agent is not saturated.
  AgentIndex Find(const ClearanceQuery& query, Instant horizon,
                  std::vector<broad_phase::Neighbour>* found);

 private:
  /// The outcome of the partners offered so far.
  struct Room {
    std::size_t pairs = 0;                       // that the agent can still have
    AgentIndex first_full = AgentIndex::None();  // the least index without room of its own
    std::vector<AgentIndex>* first;              // a heap of the least others, one more than fit
  };

  void Take(const std::vector<broad_phase::Neighbour>& found, std::size_t begin, Room* room) const;

  broad_phase::NeighbourIndex* broad_phase_;
  const AccelerationTiers& tiers_;
  const PairTable& pairs_;
  const StepClock& clock_;
  std::vector<AgentIndex> first_;  // scratch of one query, kept for its memory
};

}  // namespace collision::detection
