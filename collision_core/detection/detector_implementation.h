// How the components of the detector work together. Only detector*.cc include this.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/detection/agents/agent_table.h"
#include "collision_core/detection/clearance/clearances.h"
#include "collision_core/detection/detector.h"
#include "collision_core/detection/earliest/earliest_search.h"
#include "collision_core/detection/pairs/tracked_pairs.h"
#include "collision_core/detection/step/step_clock.h"

namespace collision::detection {

/// Owns the components and passes results from one to the next: agents change, clearances are
/// queried, pairs are evaluated. No component but this one changes the agent table or the clock.
class Detector::Implementation {
 public:
  explicit Implementation(const DetectorOptions& options);

  bool Admit(const AgentId& id, const AgentDeclaration& declaration,
             const motion::MotionState& state, Instant effective_from);
  UpdateOutcome Update(const AgentId& id, const motion::MotionState& state, Instant effective_from);
  motion::BrokenBound ExplainLastBreach() const;
  bool Redeclare(const AgentId& id, const AgentDeclaration& declaration, Instant effective_from);
  bool Remove(const AgentId& id);
  const motion::MotionState* StateOf(const AgentId& id) const;
  void ForEachAgent(const std::function<void(const HeldAgent&)>& use) const;
  void SetHeardUntil(const OwnerId& owner, Instant until, Instant still_until) {
    agents_.SetHeardUntil(owner, until, still_until);
  }
  void SetPairShare(const OwnerId& owner, const Share& share) { pairs_.SetShare(owner, share); }
  void VoidOwner(const OwnerId& owner, Instant from);
  void Advance(Instant now, const std::function<void()>& progress);

  std::vector<AgentClearance> TakeChangedClearances() { return clearances_.TakeChanged(); }
  std::optional<AgentClearance> ClearanceOf(const AgentId& id) const;
  EarliestAnswer Earliest(std::size_t queries_max);
  Profile DescribeScene() const;

  const StepClock& clock() const { return clock_; }
  const DetectorCounters& counters() const { return counters_; }
  const AgentTable& agents() const { return agents_; }
  const TrackedPairs& pairs() const { return pairs_; }
  std::size_t queued() const;
  void Validate() const;

 private:
  /// A state of a known agent, and from when a change counts.
  struct NextState {
    AgentIndex agent;
    const motion::MotionState& state;
    Instant effective_from;

    Instant stamp() const { return state.stamp; }
  };

  /// The two states of a breach.
  struct BreachedStates {
    motion::SpaceTimeBound before;
    motion::MotionState next;
    motion::OrientationUse orientation;
  };

  UpdateOutcome Return(const NextState& next);
  UpdateOutcome Jump(const NextState& next);
  UpdateOutcome Keep(const NextState& next, const motion::ContractCheck& check);
  UpdateOutcome Breach(const NextState& next, motion::OrientationUse orientation);
  void Renew(AgentIndex agent, const Renewal& renewal);
  void Tighten(AgentIndex agent);
  void Disbelieve(AgentIndex agent, Instant void_from);
  void ExpireAgents();
  void Expire(AgentIndex agent, Departure departure);
  void Leave(AgentIndex agent);
  void ForgetPast();

  StepClock clock_;
  DetectorCounters counters_;
  IndexSet<AgentIndex> clearances_dirty_;
  AgentTable agents_;
  TrackedPairs pairs_;
  Clearances clearances_;
  EarliestSearch earliest_;
  std::optional<BreachedStates> last_breach_;
};

}  // namespace collision::detection
