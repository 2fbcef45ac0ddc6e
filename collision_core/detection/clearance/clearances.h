// When agents may meet: the clearance keys of all agents, and the clearances published to them.
#pragma once

#include <vector>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/detection/clearance/clearance_queries.h"
#include "collision_core/detection/step/detector_options.h"

namespace collision::detection {

/// A renewal: from when, and why, clearances that rely on an agent's former bound no longer hold.
struct Renewal {
  Instant from;
  ClearanceCause cause = ClearanceCause::kNone;
  Instant effective_from;  ///< The agent's new promises count from here.
};

/// The component that keeps never-late true for pairs that are not tracked: it owns the broad
/// phase, the clearance keys and the queries, and derives the clearances that are published.
class Clearances {
 public:
  /// `pairs` outlives the object.
  Clearances(const DetectorOptions& options, const DetectorContext& context, TrackedPairs* pairs);

  /// The agent of this index is new. Unchecked: Renew() follows before the step, once the agent has
  /// a state; Validate() finds it.
  void AddAgent(AgentIndex agent);
  /// An agent that had expired is back. Unchecked: Renew() follows before the step; Validate()
  /// finds it.
  void Readmit(AgentIndex agent) { coverage_[agent].keys.SetAll(Instant::Never()); }
  /// The newest bound may reach beyond the former one: the agent is queried again in the next step.
  void Renew(AgentIndex agent, const Renewal& renewal);
  /// Marks the partners in the agent's tracked pairs: its renewal may lower their clearance.
  void NotifyPartners(AgentIndex agent);
  /// The newest bound, widened by the margin, lies inside the former one: all keys stay valid.
  void Tighten(AgentIndex agent);
  /// The agent has a new state that keeps its contract and may lie ahead of its key.
  void StateAdvanced(AgentIndex agent) { coverage_.StateAdvanced(agent); }
  /// Up to `until` the agent moved within `bound`, which its newest bound does not contain.
  void RecordFormerMotion(AgentIndex agent, const broad_phase::AgentBound& bound, Instant until) {
    former_.Record(agent, bound, until);
  }
  /// The agent broke its bound some time after its last honest state.
  void RecordBreach(AgentIndex agent, Instant last_honest) {
    reported_.RecordBreach(agent, last_honest);
  }
  /// Promises to the agent are void from `from` on, since the owner's clock of `culprit` is off.
  void RecordVoid(AgentIndex agent, AgentIndex culprit, Instant from) {
    reported_.RecordVoid(agent, culprit, from);
  }
  /// The agent has expired: promises exclude it until Readmit().
  void Remove(AgentIndex agent);
  /// The agent has left.
  void Forget(AgentIndex agent) { coverage_.Forget(agent); }

  /// Queries all agents that were renewed or are due. Once a step.
  void QueryDueAgents();
  /// The keys of the two agents of each pair cover it from now on.
  void Cover(const std::vector<ReleasedPair>& pairs);
  /// No query will be about a time before `since`.
  void ForgetBefore(Instant since) { former_.Forget(since); }

  std::vector<AgentClearance> TakeChanged() { return reported_.TakeChanged(); }
  AgentClearance Of(AgentIndex agent) const { return reported_.Of(agent); }

  /// For EarliestSearch.
  const CoverageTable& coverage() const { return coverage_; }
  IndexSet<AgentIndex>* voided() { return coverage_.voided(); }
  broad_phase::AdaptiveBroadPhase* broad_phase() { return &broad_phase_; }
  PreJumpMotions* former() { return &former_; }
  const broad_phase::AdaptiveBroadPhase& broad_phase() const { return broad_phase_; }
  /// Brings the counters of the broad phase's work up to date.
  void UpdateCounters();

  /// Walks the keys and the broad phase, which holds exactly the agents that have not expired.
  void Validate() const;

 private:
  const DetectorContext context_;
  TrackedPairs* pairs_;
  broad_phase::AdaptiveBroadPhase
      broad_phase_;  // the wide bounds of all agents that have not expired
  std::uint64_t pair_queries_seen_ = 0;
  PreJumpMotions former_;
  ClearanceFilter filter_;
  CoverageTable coverage_;
  ReportedClearances reported_;
  ClearanceQueries queries_;
};

}  // namespace collision::detection
