// All agents: their names, states, owners and expiries.
#pragma once

#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "collision_core/base/event_queue.h"
#include "collision_core/base/ids.h"
#include "collision_core/base/index_set.h"
#include "collision_core/detection/agents/agent_record.h"
#include "collision_core/detection/agents/scene_extremes.h"

namespace collision::detection {

/// Limits of the table; the fields of DetectorOptions of the same names.
struct AgentLimits {
  std::uint32_t agents_max = 1000;
  std::uint32_t history_max = 64;
  double skew = 0;  ///< [s]
};

/// Holds each agent under a stable index. An agent's life: Admit(), any number of Store(), Remove()
/// by its owner, and Release() once its reported time has passed; or SetExpired() and Store()
/// again. All is O(1) amortized but for the expiries' O(log agents). Single-threaded.
///
/// A removed agent has no name any more but stays in the table up to the time that its owner has
/// reported, so that its pairs are evaluated a last time.
class AgentTable {
 public:
  explicit AgentTable(const AgentLimits& limits) : limits_(limits) {}

  /// The index of a new agent without any state yet. None() if `agents_max` is reached, for a
  /// half-space kHalfSpacesMax, those that leave included, or if the id is present. Requires that
  /// an awaited shape is null. Unchecked: Store() follows before anything else is asked about the
  /// agent.
  AgentIndex Admit(const AgentId& id, const AgentDeclaration& declaration, Instant stamp);

  /// None() if there is no agent of this name.
  AgentIndex Find(const AgentId& id) const;
  bool Contains(AgentIndex agent) const {
    return agent.value() < agents_.size() && agents_[agent.value()] != nullptr;
  }
  /// Requires Contains(agent).
  AgentRecord& operator[](AgentIndex agent) { return *Checked(agent); }
  const AgentRecord& operator[](AgentIndex agent) const { return *Checked(agent); }
  /// Agents that have a name.
  std::size_t size() const { return index_.size(); }
  std::size_t half_spaces() const { return half_spaces_; }
  /// Agents that are removed and not released.
  std::size_t departing() const { return agents_.size() - free_.size() - index_.size(); }
  /// One more than the greatest index ever used.
  std::size_t index_end() const { return agents_.size(); }

  /// Appends a state under the agent's declaration to its history. Unchecked: RecordBound() follows
  /// before the step; Validate() finds a bound beyond extremes() or with other features.
  void Store(AgentIndex agent, const motion::MotionState& state, Link link);
  /// The newest bound has changed, by a state or a declaration: records its expiry, and updates
  /// extremes() and profile().
  void RecordBound(AgentIndex agent);
  /// Records that the agent has changed in this step.
  void MarkChanged(AgentIndex agent) { changed_.Insert(agent); }
  const IndexSet<AgentIndex>& changed() const { return changed_; }

  /// The owner has reported everything about its agents up to `until`. O(log owners), whatever the
  /// number of agents. Has no effect for an owner without agents in the table, or if `until` is
  /// earlier than before.
  void SetHeardUntil(const OwnerId& owner, Instant until, Instant still_until = Instant::Always());

  /// The owner gives the agent up. Unless its newest state has an expiry, the agent expires at
  /// heard_until().
  void Remove(AgentIndex agent);
  /// Takes the agents that expire by `now` out of the queue: first the removed ones in the order of
  /// their removal, then the others in the order of their ids.
  std::vector<AgentIndex> TakeExpired(Instant now);
  /// Promises exclude the agent from its newest state on.
  void ExpireAtItsStamp(AgentIndex agent);
  void SetExpired(AgentIndex agent) { (*this)[agent].expired = true; }
  /// Frees the index of a removed agent; it is reused by later admissions.
  void Release(AgentIndex agent);
  std::size_t expiries() const { return expiries_.size(); }

  /// Brings extremes() up to date by examining some of the agents (scene_extremes.h). Once a step.
  void UpdateExtremes();
  /// Bounds of all newest states together, never narrower than the truth.
  const SceneExtremes::Bounds& extremes() const { return extremes_.bounds(); }
  const SceneProfile& profile() const { return profile_; }
  double skew() const { return limits_.skew; }

  /// The step is over: forgets each changed agent's past before `needed_from(agent)`.
  template <typename NeededFrom>
  void EndStep(const NeededFrom& needed_from) {
    for (const AgentIndex agent : changed_) {
      if (Contains(agent)) (*this)[agent].history.Trim(needed_from(agent));
    }
    changed_.Clear();
  }

  /// Walks the whole table: names, owners' counts, expiries, free indices, extremes() and
  /// profile().
  void Validate() const;

 private:
  struct IdHash {
    std::size_t operator()(const AgentId& id) const;
  };

  AgentRecord* Checked(AgentIndex agent) const {
    CORE_CHECK(Contains(agent), "an agent that is held has this index", agent.value());
    return agents_[agent.value()].get();
  }
  void LeaveOwner(AgentRecord* record);

  const AgentLimits limits_;
  std::unordered_map<AgentId, AgentIndex, IdHash> index_;  // never walked over but to validate
  std::vector<std::unique_ptr<AgentRecord>> agents_;       // by index; null: free
  std::vector<AgentIndex> free_;
  std::map<OwnerId, Owner> owners_;
  std::uint64_t removals_ = 0;
  std::size_t half_spaces_ = 0;
  EventQueue<AgentIndex> expiries_;
  IndexSet<AgentIndex> changed_;  // since the last step
  SceneExtremes extremes_;
  SceneProfile profile_;
};

}  // namespace collision::detection
