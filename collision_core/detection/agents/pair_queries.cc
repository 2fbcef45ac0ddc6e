#include "collision_core/detection/agents/pair_queries.h"

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/shape/fixed_half_space.h"

namespace collision::detection {

broad_phase::HalfSpace HalfSpaceOf(const AgentRecord& agent) {
  const shape::FixedHalfSpace& body = *agent.declaration.half_space;
  return {body.normal(), body.offset(), agent.declaration.filter};
}

bool PairQueries::MayMeet(AgentIndex a, AgentIndex b) const {
  const AgentRecord &of_a = agents_[a], &of_b = agents_[b];
  return CanMeet(of_a.declaration.filter, of_b.declaration.filter) &&
         !(of_a.is_half_space() && of_b.is_half_space());
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
  const AgentRecord &of_a = agents_[a.agent], &of_b = agents_[b.agent];
  if (of_a.is_half_space()) {
    return of_b.is_half_space() ? Instant::Never() : EarliestAt(of_a, b, from);
  }
  if (of_b.is_half_space()) return EarliestAt(of_b, a, from);
  return intersection::EarliestIntersection(a.bound, b.bound, from).instant();
}

Instant PairQueries::EarliestAt(const AgentRecord& record, const QueriedAgent& agent,
                                Instant from) const {
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, from, Instant::Never()};
  return EarliestIntersectionOf(query, HalfSpaceOf(record), {agent.bound, agent.filter}).instant();
}

}  // namespace collision::detection
