// Which two agents of a whole set can meet first: the one-shot interface of the broad phase.
#pragma once

#include <optional>

#include "collision_core/broad_phase/agent_bounds.h"
#include "collision_core/broad_phase/broad_phase_work.h"
#include "collision_core/intersection/intersection_query.h"

namespace collision::broad_phase {

/// Finds the earliest pair of a set of bounds in one sweep over all of them: set every bound, ask
/// once. It answers the paper's own query (t_end, the earliest possible intersection of all),
/// which the paper's collision loop (tests/baselines/global_loop.h) asks before it evaluates any
/// frame. A service that follows many agents asks a NeighbourIndex instead, agent by agent.
///
/// As for NeighbourIndex, methods differ in cost alone: the time is EarliestIntersectionOf() of the
/// pair, bit for bit. Source: Hubbard, "Collision detection for interactive graphics applications",
/// IEEE TVCG 1(3), 1995, section 4.
class EarliestSweep : public virtual AgentBounds {
 public:
  /// The earliest possible intersection of all pairs within the query's window; of equal ones that
  /// of the lower indices. nullopt: none.
  virtual std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) = 0;

  virtual BroadPhaseWork work() const = 0;
};

}  // namespace collision::broad_phase
