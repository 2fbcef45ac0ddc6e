// The query about one group of an agent's partners.
#pragma once

#include <vector>

#include "collision_core/broad_phase/neighbour_index.h"
#include "collision_core/detection/clearance/keys/reported_clearances.h"
#include "collision_core/detection/clearance/search/due_meeting_search.h"
#include "collision_core/detection/clearance/search/next_meeting_search.h"
#include "collision_core/detection/clearance/search/uncovered_search.h"

namespace collision::detection {

/// What the queries read and change beside the DetectorContext. All outlive them.
struct QueryTargets {
  CoverageTable* coverage;
  ReportedClearances* reported;
  TrackedPairs* pairs;
  broad_phase::NeighbourIndex* broad_phase;  ///< Holds the wide bounds of all agents.
  PreJumpMotions* former;
};

/// Finds the partners of one group that an agent may meet, and tracks those that it may meet by
/// announce_until. Without room for one of them it saturates the agent.
///
/// If the agent has no room for another pair, one partner that should be tracked is enough to
/// saturate it. The partner that saturated it before is tested first: usually one pair query.
class GroupQuery {
 public:
  GroupQuery(const DetectorContext& context, const QueryTargets& targets);

  const QueryHorizons& horizons() const { return next_.horizons(); }

  /// Tracks the partners that may be met soon, and marks them in `query.tracked`. Returns the
  /// first meeting with one of the others; none if the agent is saturated afterwards.
  NextMeeting Find(const ClearanceQuery& query);

  /// Whether the agent is tracked with every partner of the group, so that no query is needed.
  bool TracksAll(AgentIndex agent, int group) const;

  /// Partners examined besides the broad phase's own tests, since the start.
  std::uint64_t looks() const { return next_.looks(); }

 private:
  void TrackUncovered(const ClearanceQuery& query);
  bool IsCrowded(const ClearanceQuery& query);
  NextMeeting QueryBroadPhase(const ClearanceQuery& query);
  void TrackDue(const ClearanceQuery& query);
  void TrackOrSaturate(const ClearanceQuery& query, const UncoveredPartner& partner, Past past);

  const DetectorContext context_;
  CoverageTable& coverage_;
  ReportedClearances& reported_;
  TrackedPairs& pairs_;
  UncoveredSearch uncovered_;
  DueMeetingSearch due_;
  NextMeetingSearch next_;
  bool in_crowd_ = false;                      // the last query left its agent saturated
  std::vector<broad_phase::Neighbour> found_;  // scratch of one query, kept for its memory
};

}  // namespace collision::detection
