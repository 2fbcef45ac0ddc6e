// Whether two agents can meet, and when first.
#pragma once

#include "collision_core/broad_phase/agent_bound.h"
#include "collision_core/broad_phase/half_space.h"
#include "collision_core/detection/agents/detector_context.h"

namespace collision::detection {

/// One agent of a query, with a bound and a filter that it has, had, or may have.
struct QueriedAgent {
  /// Unchecked: bound and filter outlive the query.
  QueriedAgent(AgentIndex of_agent, const motion::SpaceTimeBound& of_bound,
               const broad_phase::CollisionFilter& of_filter)
      : agent(of_agent), bound(of_bound), filter(of_filter) {}
  QueriedAgent(AgentIndex of_agent, const broad_phase::AgentBound& of_bound)
      : QueriedAgent(of_agent, of_bound.bound, of_bound.filter) {}

  AgentIndex agent;
  const motion::SpaceTimeBound& bound;
  const broad_phase::CollisionFilter& filter;
};

/// Where the broad phase finds the agent. Requires agent.is_half_space().
broad_phase::HalfSpace HalfSpaceOf(const AgentRecord& agent);

/// The queries of the detector about single pairs.
///
/// What is agreed about a pair besides its bounds enters the detector here and in the neighbour
/// index (broad_phase/agent_bounds.h): the filters of the two agents.
///
/// Each earliest intersection that is computed counts as one pair query.
class PairQueries {
 public:
  explicit PairQueries(const DetectorContext& context)
      : agents_(context.agents), counters_(context.counters) {}

  /// Whether the two can meet at all under their latest declarations.
  bool MayMeet(AgentIndex a, AgentIndex b) const;

  /// When the two may first meet at or after `from` under their newest bounds: the canonical
  /// answer, rounded down. Never() if they do not.
  Instant EarliestOf(AgentIndex a, AgentIndex b, Instant from) const;

  /// The same under the wide bounds, from which clearance keys are computed.
  Instant EarliestOfWide(AgentIndex a, AgentIndex b, Instant from) const;

  /// The same under bounds of the caller's choice. A half-space is where it is, whatever its bound.
  Instant EarliestUnder(const QueriedAgent& a, const QueriedAgent& b, Instant from) const;

 private:
  Instant EarliestAt(const AgentRecord& half_space, const QueriedAgent& agent, Instant from) const;

  const AgentTable& agents_;
  DetectorCounters* counters_;
};

}  // namespace collision::detection
