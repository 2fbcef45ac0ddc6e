// The questions to the broad phase, and the keys and tracked pairs that follow.
#pragma once

#include <vector>

#include "collision_core/broad_phase/neighbour_index.h"
#include "collision_core/detection/clearance/due_meeting_search.h"
#include "collision_core/detection/clearance/key_lowering.h"
#include "collision_core/detection/clearance/next_meeting_search.h"
#include "collision_core/detection/clearance/uncovered_search.h"

namespace collision::detection {

/// What the questions read and change beside the DetectorContext. All outlive them.
struct QueryTargets {
  CoverageTable* coverage;
  ToldClearances* told;
  TrackedPairs* pairs;
  broad_phase::NeighbourIndex* broad_phase;  ///< Holds the wide bounds of all agents.
  const ClearanceFilter& filter;
  PreJumpMotions* former;
};

/// Asks the broad phase about each agent that was renewed and each whose key is due. Partners that
/// may be met by announce_until become tracked pairs; the earliest of the others is the new key.
///
/// - A question begins where the agent is no longer certified clear, and looks no farther than it
///   must (QueryHorizons). An agent is asked about each group of partners (AccelerationTiers) whose
///   key is due, about all groups if it was renewed, and not about a tier that is tracked as a
///   whole.
/// - A renewed agent then has the keys of others lowered (KeyLowering). Agents renewed or asked
///   about in the same step are asked about the new bound itself, so that of many changes at once
///   each costs one question, and the broad phase is brought up to date once for all.
/// - Of an agent that has no room for another pair one thing is asked: is there still a partner
///   that should be tracked? Usually it is one that was in the way before: one pair query.
class ClearanceQueries {
 public:
  ClearanceQueries(const DetectorContext& context, const QueryTargets& targets);

  /// Asks about all agents that were renewed or are due. Once a step.
  void QueryDueAgents();

  /// Partners looked at beside the broad phase's own tests, since the start.
  std::uint64_t looks() const { return next_.looks() + lowering_.looks(); }

 private:
  /// How many agents were renewed in this step.
  enum class Renewals { kFew, kMany };

  /// What held of an agent before it is asked about.
  struct Promised {
    const ClearanceKeys& keys;
    Instant covered;              // certified clear of all untracked partners up to here
    bool renewed, was_saturated;  // as of ClearanceQuestion
  };

  void Query(AgentIndex agent, Renewals renewals);
  bool NeedsTiersOnly(AgentIndex agent, Renewals renewals) const;
  void QueryTiers(AgentIndex agent);
  void QueryAll(AgentIndex agent, Renewals renewals);
  NextMeeting QueryGroups(AgentIndex agent, const Promised& promised);
  ClearanceQuestion QuestionAbout(AgentIndex agent, int group, const Promised& promised);
  NextMeeting QueryGroup(const ClearanceQuestion& question);
  NextMeeting QueryBroadPhase(const ClearanceQuestion& question);
  bool IsCrowded(const ClearanceQuestion& question);
  void TrackUncovered(const ClearanceQuestion& question);
  void TrackDue(const ClearanceQuestion& question,
                const std::vector<broad_phase::Neighbour>& found);
  void TrackOrSaturate(const ClearanceQuestion& question, const UncoveredPartner& partner,
                       Past past);
  bool TracksAll(AgentIndex agent, int group) const;
  Instant DueUntil(AgentIndex agent) const;
  void QueryFarKeysAnew();
  void NotifyIfLowered(AgentIndex agent, Instant before);
  void SettleQueried();

  const DetectorContext context_;
  CoverageTable& coverage_;
  ToldClearances& told_;
  TrackedPairs& pairs_;
  UncoveredSearch uncovered_;
  DueMeetingSearch due_;
  NextMeetingSearch next_;
  KeyLowering lowering_;
  std::vector<AgentIndex> queried_;  // about all groups, in this step
  bool in_crowd_ = false;            // the last question left its agent saturated
  // Scratch of one question, kept for its memory.
  PartnerMarks tracked_;
  std::vector<broad_phase::Neighbour> found_;
  std::vector<int> groups_;
  std::vector<AgentIndex> far_;
};

}  // namespace collision::detection
