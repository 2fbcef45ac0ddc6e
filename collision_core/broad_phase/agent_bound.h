// A space-time bound, and which other agents it can meet at all.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/collision_filter.h"
#include "collision_core/intersection/intersection_query.h"

namespace collision::broad_phase {

/// What the broad phase holds of an agent. A bound alone stands for one that can meet every other.
struct AgentBound {
  AgentBound() = default;
  AgentBound(const motion::SpaceTimeBound& of_agent, const CollisionFilter& filtered = {})
      : bound(of_agent), filter(filtered) {}

  motion::SpaceTimeBound bound;
  CollisionFilter filter;
};

/// By agent; nullopt: no agent of that index.
using BoundList = std::vector<std::optional<AgentBound>>;

inline bool Holds(const BoundList& bounds, std::uint32_t agent) {
  return agent < bounds.size() && bounds[agent].has_value();
}

/// EarliestIntersection() of the two bounds at or after `from`; never if their filters keep them
/// apart.
inline intersection::IntersectionTime EarliestIntersection(const AgentBound& a, const AgentBound& b,
                                                           Instant from) {
  if (!CanMeet(a.filter, b.filter)) return {from, numeric::kInfinity};
  return intersection::EarliestIntersection(a.bound, b.bound, from);
}

/// Likewise the answer to a query about the two, with their margin [m].
inline intersection::IntersectionTime EarliestIntersectionOf(const intersection::BroadQuery& query,
                                                             const AgentBound& a,
                                                             const AgentBound& b,
                                                             double margin = 0) {
  if (!CanMeet(a.filter, b.filter)) return {query.from, numeric::kInfinity};
  return intersection::EarliestIntersectionOf(query, a.bound, b.bound, margin);
}

}  // namespace collision::broad_phase
