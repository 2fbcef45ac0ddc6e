// The query about one band of an agent's partners.
#pragma once

#include <vector>

#include "collision_core/broad_phase/neighbour_index.h"
#include "collision_core/detection/clearance/keys/reported_clearances.h"
#include "collision_core/detection/clearance/search/due_neighbour_search.h"
#include "collision_core/detection/clearance/search/next_neighbour_search.h"
#include "collision_core/detection/clearance/search/uncovered_search.h"

namespace collision::detection {

/// What the queries read and change besides the DetectorContext. All outlive them.
struct QueryTargets {
  CoverageTable* coverage;
  ReportedClearances* reported;
  TrackedPairs* pairs;
  broad_phase::NeighbourIndex* broad_phase;  ///< Holds the wide bounds of all agents.
  PreJumpMotions* former;
};

/// Finds the partners of one band that an agent may meet, and tracks those that it may meet by
/// announce_until. Without room for one of them it saturates the agent.
///
/// If the agent has no room for another pair, one partner that should be tracked is enough to
/// saturate it. The partner that saturated it before is tested first: usually one pair query.
class BandQuery {
 public:
  BandQuery(const DetectorContext& context, const QueryTargets& targets);

  const QueryHorizons& horizons() const { return next_.horizons(); }

  /// Tracks the partners that may be met soon, and marks them in `query.tracked`. Returns the
  /// first intersection with one of the others; none if the agent is saturated afterwards.
  NextNeighbour Find(const ClearanceQuery& query);

  /// Whether the agent is tracked with every partner of the band, so that no query is needed.
  bool TracksAll(AgentIndex agent, int band) const;

  /// Partners examined besides the broad phase's own tests, since the start.
  std::uint64_t examined() const { return next_.examined(); }

 private:
  void TrackUncovered(const ClearanceQuery& query);
  bool IsCrowded(const ClearanceQuery& query);
  NextNeighbour QueryBroadPhase(const ClearanceQuery& query);
  void TrackDue(const ClearanceQuery& query);
  void TrackOrSaturate(const ClearanceQuery& query, const UncoveredPartner& partner, Past past);

  const DetectorContext context_;
  const PairQueries queries_;
  CoverageTable& coverage_;
  ReportedClearances& reported_;
  TrackedPairs& pairs_;
  UncoveredSearch uncovered_;
  DueNeighbourSearch due_;
  NextNeighbourSearch next_;
  bool in_crowd_ = false;                      // the last query left its agent saturated
  std::vector<broad_phase::Neighbour> found_;  // scratch of one query, kept for its memory
};

}  // namespace collision::detection
