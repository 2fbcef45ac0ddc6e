#include "collision_core/broad_phase/index/pair_time.h"

namespace collision::broad_phase {

bool CanMeet(intersection::BoundKind kind, const AgentBound& a, const AgentBound& b) {
  const bool horns = kind == intersection::BoundKind::kHorn;
  if (horns && NeverMoves(a.bound) && NeverMoves(b.bound)) return false;
  return CanMeet(a.filter, b.filter);
}

intersection::IntersectionTime PairTimeOf(const intersection::BroadQuery& query,
                                          const AgentBounds& set, const BoundList& bounds,
                                          std::pair<std::uint32_t, std::uint32_t> pair,
                                          BroadPhaseWork* work) {
  const intersection::IntersectionTime never{query.from, numeric::kInfinity};
  const auto [a, b] = pair;
  const intersection::PairRule rule = set.rules().Of(a, b);
  const bool has_a = Holds(bounds, a), has_b = Holds(bounds, b);
  if (rule.excluded || a == b || !(has_a || has_b)) return never;
  if (has_a && has_b) {
    if (!CanMeet(query.bound, *bounds[a], *bounds[b])) return never;
    ++work->pair_queries;
    return EarliestIntersectionOf(query, *bounds[a], *bounds[b], rule.margin);
  }
  const HalfSpaces::Entry* entry = set.half_spaces().Find(has_a ? b : a);
  const AgentBound& bound = *bounds[has_a ? a : b];
  if (entry == nullptr || !CanMeet(entry->half_space, bound)) return never;
  ++work->pair_queries;
  return EarliestIntersectionOf(query, entry->half_space, bound, rule.margin);
}

}  // namespace collision::broad_phase
