// The search for the earliest possible intersection over all agents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision_core/detection/clearance/clearances.h"
#include "collision_core/detection/clearance/search/next_neighbour_search.h"
#include "collision_core/detection/clearance/search/uncovered_search.h"
#include "collision_core/detection/earliest/earliest_answer.h"
#include "collision_core/detection/pairs/tracked_pairs.h"

namespace collision::detection {

/// Answers Detector::Earliest(), over all pairs that are not in contact, though only few pairs are
/// queried. A pair counts with its canonical answer from now on. Three cases differ: a tracked pair
/// with a known shape counts with the later of that and its certified freedom; a pair with a state
/// or a known contact ahead of now with the end of its certified freedom or the begin of the
/// contact, if earlier; a saturated agent with now. A contact that is settled, its event ended,
/// counts no more, even if it lies ahead of now.
///
/// For each agent and each tracked pair the search remembers a *lower bound* of what it can add to
/// the answer. Two queues order them; agents and pairs are queried in the order of their bounds
/// until no bound is early enough to better the best answer. A bound that is early enough is first
/// computed anew from now on, which usually is enough for many steps.
///
/// An agent's bound is its earliest clearance key, or the agent's next intersection as found by a
/// query of the search's own. Both hold for each untracked partner as long as neither bound
/// widens. Where a partner is renewed later, the bound of that partner, which is void from then on
/// (CoverageTable::voided), covers the pair. Bounds are computed from wide bounds (BoundMargin), so
/// that they hold for newer states that keep their contracts.
///
/// Between two steps an agent may have been renewed, or may have received a state beyond its key.
/// Then the search examines what lies before its newest state as the next step will, and the
/// agent's bound stays unknown.
///
/// What is remembered is a cache of its own: keys, pairs, events and clearances do not depend on
/// whether the search is ever called.
///
/// In a lattice all agents tie, and an exact answer costs O(N). A call with a limit ends the search
/// after so many queries; the first bound left in a queue is then offered as it is, since all
/// others in that queue are later.
class EarliestSearch {
 public:
  /// All outlive the search.
  EarliestSearch(const DetectorContext& context, TrackedPairs* pairs, Clearances* clearances);

  /// As of the last step. After `queries_max` queries no other agent or pair is queried; one more
  /// may be under way.
  EarliestAnswer Find(std::size_t queries_max);

  void Validate() const;

 private:
  struct AgentLowerBound {
    std::uint64_t computed_step = 0;
    AgentIndex next_partner;  // may be met at the bound, as far as is known
  };
  struct PairLowerBound {
    std::uint64_t canonical_step = 0;
    Instant canonical = Instant::Never();  // the earliest intersection as of that step
  };
  /// An agent or pair that was taken out of its queue, to be put back.
  template <typename IndexType>
  struct Taken {
    IndexType index;
    Instant bound;
  };
  struct Run;  // one call of Find()

  void TakeChanges();
  void OfferSaturated(Run* run) const;
  void OfferPairs(Run* run);
  void OfferPair(PairSlot slot, Run* run);
  Instant LowerBoundOf(const PairRecord& pair) const;
  void OfferAgents(Run* run);
  bool IsUncovered(AgentIndex agent) const;
  /// Offers the agent's bound in place of what a query would find.
  void OfferBound(AgentIndex agent, Instant bound, Run* run) const;
  void OfferUncovered(AgentIndex agent, Run* run);
  void ComputeBound(AgentIndex agent, Run* run);
  /// Marks the partners with which the agent is tracked; valid until the next call.
  PartnerMarks& TrackedWith(AgentIndex agent);
  void OfferPartners(AgentIndex agent, Instant bound, Run* run);
  void OfferNeighbours(AgentIndex agent, const broad_phase::NeighbourWindow& window,
                       const PartnerMarks& tracked, Run* run);
  Instant Canonical(AgentIndex a, AgentIndex b, Run* run) const;

  const DetectorContext context_;
  const PairQueries queries_;
  const PairTable& pairs_;
  const CoverageTable& coverage_;
  IndexSet<PairSlot>* pairs_changed_;
  IndexSet<AgentIndex>* agents_voided_;
  broad_phase::NeighbourIndex* broad_phase_;
  NextNeighbourSearch next_;
  UncoveredSearch uncovered_;
  EventQueue<AgentIndex> agent_bounds_;  // Always(): not known
  EventQueue<PairSlot> pair_bounds_;     // likewise; of pairs that are not in contact
  IndexedVector<AgentIndex, AgentLowerBound> agents_;
  IndexedVector<PairSlot, PairLowerBound> pair_answers_;
  // Memory of one query, which each fills anew.
  PartnerMarks tracked_memory_;
  std::vector<broad_phase::Neighbour> found_memory_;
};

}  // namespace collision::detection
