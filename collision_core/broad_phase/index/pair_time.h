// The canonical answer for two entries of a set of bounds, agents or half-spaces.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/agent_bounds.h"
#include "collision_core/broad_phase/broad_phase_work.h"
#include "collision_core/intersection/intersection_query.h"

namespace collision::broad_phase {

/// Bounds by agent; nullopt: no agent of that index.
using BoundList = std::vector<std::optional<motion::SpaceTimeBound>>;

inline bool Holds(const BoundList& bounds, std::uint32_t agent) {
  return agent < bounds.size() && bounds[agent].has_value();
}

/// Whether the canonical routine can give a time at all: collision filters, and one of the two
/// moves.
bool CanMeet(intersection::BoundKind kind, const motion::SpaceTimeBound& a,
             const motion::SpaceTimeBound& b);

/// EarliestIntersectionOf() of two entries, one of which may be a half-space of `set`, under the
/// pair's rule; +infinity if one is not held, or if they cannot meet. Counts a pair query where the
/// routine is asked.
intersection::IntersectionTime PairTimeOf(const intersection::BroadQuery& query,
                                          const AgentBounds& set, const BoundList& bounds,
                                          std::pair<std::uint32_t, std::uint32_t> pair,
                                          BroadPhaseWork* work);

}  // namespace collision::broad_phase
