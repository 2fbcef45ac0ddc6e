// Up to when each agent is certified clear of the partners that it is not tracked with.
#pragma once

#include <optional>

#include "collision_core/base/ids.h"
#include "collision_core/detection/clearance/agent_clearance.h"
#include "collision_core/detection/clearance/clearance_keys.h"
#include "collision_core/detection/detector_counters.h"
#include "collision_core/detection/pairs/tracked_pairs.h"

namespace collision::detection {

/// What clearance/ holds of one agent.
struct AgentCoverage {
  static constexpr std::uint64_t kNeverQueried = ~std::uint64_t{0};

  ClearanceKeys keys;       ///< Of a saturated agent they promise nothing.
  AgentIndex next_partner;  ///< A partner that may be met at the earliest key, as far as is known.
  /// From here on nothing holds that was promised before (admission, jump, breach, widening): all
  /// partners must be asked about anew. nullopt: not renewed since the last question.
  std::optional<Instant> renewed_from;
  ClearanceCause renewed_cause = ClearanceCause::kNone;
  std::uint64_t queried_step = 0;  ///< The step of the last question, or kNeverQueried.
  AgentIndex crowded_with;         ///< Saturated: a partner that could not be tracked.
};

/// The clearance keys of all agents, and who is asked again when.
///
/// Invariants. After a step, for each two agents that can meet, one of these holds: they are
/// tracked; they are certified clear up to the later of their two keys, which is later than both
/// newest states; both are saturated. And each key is later than announce_until, or its agent
/// saturated.
///
/// Two queues order the agents: by the time at which an agent must be asked again, and by the key
/// of its comparable partners, the latest first, for those whose key a renewed agent may have to
/// lower. Every operation is O(log agents).
class CoverageTable {
 public:
  explicit CoverageTable(const DetectorContext& context) : context_(context) {}

  /// The agent of this index is new: it is asked about at the next step.
  void AddAgent(AgentIndex agent);
  /// Requires AddAgent().
  AgentCoverage& operator[](AgentIndex agent) { return agents_.at(agent); }
  const AgentCoverage& operator[](AgentIndex agent) const { return agents_.at(agent); }
  const AccelerationTiers& tiers() const { return tiers_; }

  /// Up to when the agent is certified clear of the partner, if the two are not tracked.
  Instant KeyOf(AgentIndex agent, AgentIndex partner) const {
    const ClearanceKeys& keys = (*this)[agent].keys;
    if (!tiers_.HasGroupsBeside(agent)) return keys.earliest();
    return keys.Of(tiers_.GroupOf(partner, agent));
  }
  /// They may meet at `when`, if the agent's key does not say earlier.
  void LowerKey(AgentIndex agent, AgentIndex partner, Instant when);
  /// The agent's keys have been set: brings the queues up to date.
  void KeysChanged(AgentIndex agent);

  /// Nothing that was promised of the agent from `from` on holds: it is asked about at the next
  /// step.
  void Renew(AgentIndex agent, Instant from, ClearanceCause cause);
  /// The agent's newest state may lie beyond its key (its owner was granted more time before the
  /// key was lowered): then it is asked about first of all.
  void StateAdvanced(AgentIndex agent);
  /// The agent is asked about in this step, as if its key were due.
  void QueryAtOnce(AgentIndex agent) { due_.Set(agent, Instant::Always()); }
  /// The agent's promises have run out: it is not asked about until Renew().
  void Remove(AgentIndex agent);
  /// The agent has left; its index may be reused.
  void Forget(AgentIndex agent) { saturated_.Erase(agent); }

  /// There is no room to track the agent with `partner`: it may touch at any time, is told so, and
  /// is asked about again a little later.
  void Saturate(AgentIndex agent, AgentIndex partner);
  void EndSaturation(AgentIndex agent) { saturated_.Erase(agent); }
  bool IsSaturated(AgentIndex agent) const { return saturated_.Contains(agent); }
  const IndexSet<AgentIndex>& saturated() const { return saturated_; }
  /// The agent that Saturate() was last called for, and the partner that it could not be tracked
  /// with; None() if there is none. Either may have left since.
  AgentIndex last_saturated() const { return last_saturated_; }
  AgentIndex last_untracked() const { return last_untracked_; }

  /// Agents renewed since the last step, in the order of their renewal.
  IndexSet<AgentIndex>* renewed() { return &renewed_; }

  /// Agents by the time at which they must be asked again.
  const EventQueue<AgentIndex>& due() const { return due_; }
  /// The agent is asked about everything now: no key of an earlier step is left to be lowered.
  void LeaveSettled(AgentIndex agent) { settled_.Remove(agent); }
  /// From now on a renewed agent may lower the agent's keys.
  void Settle(AgentIndex agent);
  bool IsSettled(AgentIndex agent) const { return settled_.Contains(agent); }
  std::size_t settled() const { return settled_.size(); }
  /// The latest key of a comparable partner among the settled agents. Requires settled() > 0.
  Instant LatestKey() const { return Reversed(settled_.top_key()); }
  /// Appends the settled agents whose comparable key is not earlier than `from`.
  void AppendSettledFrom(Instant from, std::vector<AgentIndex>* agents) const {
    settled_.UpTo(Reversed(from), agents);
  }

  /// Agents whose earlier lower bounds of a meeting are void (earliest/); whoever reads them clears
  /// the set.
  IndexSet<AgentIndex>* voided() { return &voided_; }

  /// Walks queues, sets, keys and tiers: each agent that has not expired waits to be asked again,
  /// and unless it is saturated or renewed its keys are later than announce_until as of the last
  /// step.
  void Validate() const;

 private:
  /// The order of ~key is that of the keys from the last to the first.
  static Instant Reversed(Instant key) { return Instant::FromNanoseconds(~key.nanoseconds()); }
  Instant DueAt(AgentIndex agent) const;
  void ValidateAgent(AgentIndex agent) const;

  const DetectorContext context_;
  IndexedVector<AgentIndex, AgentCoverage> agents_;
  AccelerationTiers tiers_;  // of the bounds declared at the last renewals
  EventQueue<AgentIndex> due_;
  EventQueue<AgentIndex> settled_;  // by ~key: not those renewed or asked about in this step
  IndexSet<AgentIndex> renewed_;
  IndexSet<AgentIndex> saturated_;
  AgentIndex last_saturated_ = AgentIndex::None(), last_untracked_ = AgentIndex::None();
  IndexSet<AgentIndex> voided_;
};

}  // namespace collision::detection
