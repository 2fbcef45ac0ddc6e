// The canonical answer for two entries of a set of bounds, agents or half-spaces.
#pragma once

#include <cstdint>
#include <utility>

#include "collision_core/broad_phase/agent_bounds.h"
#include "collision_core/broad_phase/broad_phase_work.h"
#include "collision_core/intersection/intersection_query.h"

namespace collision::broad_phase {

/// Whether the canonical routine can give a time at all: collision filters, and one of the two
/// moves.
bool CanMeet(intersection::BoundKind kind, const AgentBound& a, const AgentBound& b);

/// EarliestIntersectionOf() of two entries, one of which may be a half-space of `set`, under the
/// pair's rule; +infinity if one is not held, or if they cannot meet. Counts a pair query where the
/// routine is asked.
intersection::IntersectionTime PairTimeOf(const intersection::BroadQuery& query,
                                          const AgentBounds& set, const BoundList& bounds,
                                          std::pair<std::uint32_t, std::uint32_t> pair,
                                          BroadPhaseWork* work);

}  // namespace collision::broad_phase
