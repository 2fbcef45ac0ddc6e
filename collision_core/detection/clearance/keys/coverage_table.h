// Until when each agent is certified clear of the partners that it is not tracked with.
#pragma once

#include <optional>

#include "collision_core/base/ids.h"
#include "collision_core/detection/clearance/keys/agent_clearance.h"
#include "collision_core/detection/clearance/keys/clearance_keys.h"
#include "collision_core/detection/pairs/tracked_pairs.h"

namespace collision::detection {

/// The clearance keys of one agent, and what they depend on.
struct AgentCoverage {
  static constexpr std::uint64_t kNeverQueried = ~std::uint64_t{0};

  ClearanceKeys keys;       ///< Of a saturated agent they promise nothing.
  AgentIndex next_partner;  ///< A partner that the agent may meet at the earliest key, if known.
  /// Earlier promises are void from here on (admission, jump, breach, widening), and the agent must
  /// be queried for all partners. nullopt: not renewed since its last query.
  std::optional<Instant> renewed_from;
  ClearanceCause renewed_cause = ClearanceCause::kNone;
  std::uint64_t queried_step = 0;  ///< The step of the last query, or kNeverQueried.
  AgentIndex crowded_with;         ///< If saturated: a partner that could not be tracked.
};

/// The clearance keys of all agents, and when each agent is queried again.
///
/// Invariants. After a step, for each two agents that can meet, one of these holds: they are
/// tracked; they are certified clear up to the later of their two keys, which is later than both
/// newest states; both are saturated. And each key is later than announce_until, or its agent
/// saturated.
///
/// Two queues order the agents: one by the time at which an agent must be queried again; the other,
/// for agents whose key a renewed agent may have to lower, by the key of the comparable partners,
/// the latest first. Every operation is O(log agents).
class CoverageTable {
 public:
  explicit CoverageTable(const DetectorContext& context) : context_(context) {}

  /// The agent of this index is new: it is queried in the next step.
  void AddAgent(AgentIndex agent);
  /// Requires AddAgent().
  AgentCoverage& operator[](AgentIndex agent) { return agents_.at(agent); }
  const AgentCoverage& operator[](AgentIndex agent) const { return agents_.at(agent); }
  const AccelerationTiers& tiers() const { return tiers_; }

  /// Up to when the agent is certified clear of the partner, if the two are not tracked.
  Instant KeyOf(AgentIndex agent, AgentIndex partner) const {
    const ClearanceKeys& keys = (*this)[agent].keys;
    if (!tiers_.HasOwnBands(agent)) return keys.earliest();
    return keys.Of(tiers_.BandOf(partner, agent));
  }
  /// The agent may meet the partner at `when`: lowers its key for that partner to `when` if it is
  /// later.
  void LowerKey(AgentIndex agent, AgentIndex partner, Instant when);
  /// The agent's keys have been set: brings the queues up to date.
  void KeysChanged(AgentIndex agent);

  /// The promises made about the agent are void from `from` on: it is queried in the next step.
  void Renew(AgentIndex agent, Instant from, ClearanceCause cause);
  /// The agent's newest state may lie beyond its key (its owner was granted more time before the
  /// key was lowered): then it is queried first of all.
  void StateAdvanced(AgentIndex agent);
  /// The agent is queried in this step, as if its key were due.
  void QueryAtOnce(AgentIndex agent) { due_.Set(agent, Instant::Always()); }
  /// The agent's promises have run out: it is not queried until Renew().
  void Remove(AgentIndex agent);
  /// The agent has left; its index may be reused.
  void Forget(AgentIndex agent) { saturated_.Erase(agent); }

  /// There is no room to track the agent with `partner`: a contact may begin at any time. The
  /// agent's clearance becomes now, and it is queried again a little later.
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

  /// Agents by the time at which they must be queried again.
  const EventQueue<AgentIndex>& due() const { return due_; }
  /// The agent is queried for all partners in this step, so a renewed agent need not lower its
  /// keys.
  void UnmarkLowerable(AgentIndex agent) { lowerable_.Remove(agent); }
  /// The query is over: from now on the agent's keys are among those that a renewed agent may have
  /// to lower.
  void MarkLowerable(AgentIndex agent);
  bool IsLowerable(AgentIndex agent) const { return lowerable_.Contains(agent); }
  std::size_t settled() const { return lowerable_.size(); }
  /// The latest key of a comparable partner among the settled agents. Requires settled() > 0.
  Instant LatestKey() const { return Reversed(lowerable_.top_key()); }
  /// Appends the settled agents whose comparable key is not earlier than `from`.
  void AppendLowerableFrom(Instant from, std::vector<AgentIndex>* agents) const {
    lowerable_.UpTo(Reversed(from), agents);
  }

  /// Agents whose earlier lower bounds of an intersection are void (earliest/); the reader clears
  /// the set.
  IndexSet<AgentIndex>* voided() { return &voided_; }

  /// Walks queues, sets, keys and tiers. Each agent that has not expired is queued for its next
  /// query; unless it is saturated or renewed, its keys are later than announce_until as of the
  /// last step.
  void Validate() const;

 private:
  /// Turns the order of keys round: the latest key comes first.
  static Instant Reversed(Instant key) { return Instant::FromNanoseconds(~key.nanoseconds()); }
  Instant DueAt(AgentIndex agent) const;
  void ValidateAgent(AgentIndex agent) const;

  const DetectorContext context_;
  IndexedVector<AgentIndex, AgentCoverage> agents_;
  AccelerationTiers tiers_;  // of the bounds declared at the last renewals
  EventQueue<AgentIndex> due_;
  EventQueue<AgentIndex> lowerable_;  // by ~key: not those renewed or queried in this step
  IndexSet<AgentIndex> renewed_;
  IndexSet<AgentIndex> saturated_;
  AgentIndex last_saturated_ = AgentIndex::None(), last_untracked_ = AgentIndex::None();
  IndexSet<AgentIndex> voided_;
};

}  // namespace collision::detection
