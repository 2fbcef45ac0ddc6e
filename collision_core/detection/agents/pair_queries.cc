#include "collision_core/detection/agents/pair_queries.h"

#include "collision_core/intersection/earliest_intersection.h"

namespace collision::detection {

bool PairQueries::MayMeet(AgentIndex a, AgentIndex b) const {
  return CanMeet(agents_[a].declaration.filter, agents_[b].declaration.filter);
}

Instant PairQueries::EarliestOf(AgentIndex a, AgentIndex b, Instant from) const {
  const AgentRecord &of_a = agents_[a], &of_b = agents_[b];
  return EarliestUnder({a, of_a.bound(), of_a.declaration.filter},
                       {b, of_b.bound(), of_b.declaration.filter}, from);
}

Instant PairQueries::EarliestOfWide(AgentIndex a, AgentIndex b, Instant from) const {
  const broad_phase::AgentBound of_a = agents_[a].wide_bound(), of_b = agents_[b].wide_bound();
  return EarliestUnder({a, of_a}, {b, of_b}, from);
}

Instant PairQueries::EarliestUnder(const QueriedAgent& a, const QueriedAgent& b,
                                   Instant from) const {
  ++counters_->pair_queries;
  if (!CanMeet(a.filter, b.filter)) return Instant::Never();
  return intersection::EarliestIntersection(a.bound, b.bound, from).instant();
}

}  // namespace collision::detection
