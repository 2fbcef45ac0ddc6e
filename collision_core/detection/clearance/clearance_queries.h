// Which agents are queried in a step, and the clearance keys that follow.
#pragma once

#include <vector>

#include "collision_core/detection/clearance/key_lowering.h"
#include "collision_core/detection/clearance/search/band_query.h"

namespace collision::detection {

/// Queries the broad phase for each agent that was renewed and each whose key is due. Partners that
/// it may meet by announce_until become tracked pairs; the earliest intersection with one of the
/// others is the agent's new key.
///
/// - A query begins where the agent is no longer certified clear, and looks no farther than it must
///   (QueryHorizons). It covers each band of partners (AccelerationTiers) whose key is due, or all
///   bands if the agent was renewed; it leaves out a tier that is tracked as a whole (BandQuery).
/// - After the query of a renewed agent, the keys of its partners are lowered (KeyLowering). Agents
///   that are renewed or queried in the same step see the new bound in their own query. So many
///   changes in one step cost one query each, and the broad phase is brought up to date once.
class ClearanceQueries {
 public:
  ClearanceQueries(const DetectorContext& context, const QueryTargets& targets,
                   const ClearanceFilter& filter);

  /// Queries all agents that were renewed or are due. Once a step.
  void QueryDueAgents();

  /// Partners examined besides the broad phase's own tests, since the start.
  std::uint64_t examined() const { return band_query_.examined() + lowering_.examined(); }

 private:
  /// How many agents were renewed in this step.
  enum class Renewals { kFew, kMany };

  /// What held for an agent before its query.
  struct Promised {
    const ClearanceKeys& keys;
    Instant covered;              // certified clear of all untracked partners up to here
    bool renewed, was_saturated;  // as of ClearanceQuery
  };

  void Query(AgentIndex agent, Renewals renewals);
  bool NeedsTiersOnly(AgentIndex agent, Renewals renewals) const;
  void QueryTiers(AgentIndex agent);
  void QueryAll(AgentIndex agent, Renewals renewals);
  NextNeighbour QueryBands(AgentIndex agent, const Promised& promised);
  ClearanceQuery QueryFor(AgentIndex agent, int band, const Promised& promised);
  Instant DueUntil(AgentIndex agent) const;
  void QueryFarKeysAnew();
  void NotifyIfLowered(AgentIndex agent, Instant before);
  void SettleQueried();

  const DetectorContext context_;
  CoverageTable& coverage_;
  ReportedClearances& reported_;
  const PairTable& pairs_;
  BandQuery band_query_;
  KeyLowering lowering_;
  std::vector<AgentIndex> queried_;  // for all bands, in this step
  // Scratch of one query, kept for its memory.
  PartnerMarks tracked_;
  std::vector<int> bands_;
  std::vector<AgentIndex> far_;
};

}  // namespace collision::detection
