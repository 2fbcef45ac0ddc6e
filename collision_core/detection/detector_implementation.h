// The detector's insides. Only detector*.cc include this.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "collision_core/broad_phase/all_pairs.h"
#include "collision_core/detection/agent_record.h"
#include "collision_core/detection/announcer.h"
#include "collision_core/detection/detector.h"
#include "collision_core/detection/event_queue.h"
#include "collision_core/detection/pair_table.h"

namespace collision {

/// What keeps never-late true between two steps:
///  - every two agents that can meet are either a tracked pair, whose tracker says up to when they are certified
///    free, or covered: certified free up to the greater of their two keys, which is later than both newest
///    states;
///  - after a step every key is later than now + announce_within (or its agent is saturated).
class Detector::Implementation {
 public:
  explicit Implementation(const DetectorOptions& options);

  bool Admit(const AgentId& id, const AgentDeclaration& declaration, const MotionState& state,
             Instant effective_from);
  UpdateOutcome Update(const AgentId& id, const MotionState& state, Instant effective_from);
  bool Redeclare(const AgentId& id, const AgentDeclaration& declaration, Instant effective_from);
  bool Remove(const AgentId& id);
  void Hear(const AgentId& id, Instant until);
  void Advance(Instant now);

  AgentClearance Clearance(const AgentRecord& agent) const;
  std::vector<AgentClearance> TakeChangedClearances();
  std::optional<AgentClearance> ClearanceOf(const AgentId& id) const;
  EarliestAnswer Earliest();
  Profile DescribeScene() const;

  Instant now_ = Instant::Always();
  DetectorCounters counters_;
  std::map<AgentId, std::uint32_t> index_;
  PairTable pairs_;
  Announcer announcer_;

 private:
  AgentRecord* Find(const AgentId& id);
  AgentRecord& At(std::uint32_t agent) { return *agents_[agent]; }

  // Updates.
  void Put(std::uint32_t agent);
  static bool DriftedBeyondKeys(const AgentRecord& agent);
  void Renew(std::uint32_t agent, Instant from, ClearanceCause cause, Instant effective_from);
  void Tell(std::uint32_t agent, std::uint32_t cause);
  void Expire(std::uint32_t agent, bool gone);
  void Leave(std::uint32_t agent);
  void TrimHistories();

  // Asking the broad phase.
  void AskAll();
  void Ask(std::uint32_t agent);
  void TrackUncovered(std::uint32_t agent, bool renewed, Instant covered);
  Instant UncoveredFrom(const AgentRecord& a, const AgentRecord& b, Instant covered) const;
  bool FreeOver(const AgentRecord& a, const AgentRecord& b, Instant from, Instant to);
  void SetKey(std::uint32_t agent, Instant key);

  // Tracked pairs.
  void TurnAll();
  void Turn(std::uint32_t slot, bool last);
  void NoteAhead(const ContactTracker& preview, PairRecord* pair) const;
  Instant SettledUntil(const AgentRecord& agent) const;
  bool Tracked(const AgentRecord& agent, std::uint32_t partner) const;
  void Track(std::uint32_t a, std::uint32_t b, Instant free_until, bool began_before);
  void Untrack(std::uint32_t slot);
  void Drop(std::uint32_t slot, bool gone);

  DetectorOptions options_;
  std::vector<std::unique_ptr<AgentRecord>> agents_;  // by index; null: free
  std::vector<std::uint32_t> free_;
  AllPairs broad_phase_;
  EventQueue queue_;
  std::vector<std::uint32_t> renewed_;  // in the order of their renewal
  std::vector<std::uint32_t> leaving_;  // removed, but what they told reaches beyond now
  std::uint64_t broad_queries_seen_ = 0;
  std::uint64_t step_ = 0;
};

}  // namespace collision
