// The pairs that may meet soon: when each is evaluated, and what follows.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/detection/agents/detector_context.h"
#include "collision_core/detection/agents/pair_queries.h"
#include "collision_core/detection/encounter/event_facts.h"
#include "collision_core/detection/events/announcer.h"
#include "collision_core/detection/pairs/owner_queues.h"
#include "collision_core/detection/pairs/pair_evaluator.h"
#include "collision_core/detection/pairs/pair_extremes.h"
#include "collision_core/detection/pairs/pair_table.h"
#include "collision_core/detection/pairs/step_budget.h"
#include "collision_core/detection/step/detector_options.h"

namespace collision::detection {

/// A pair that is no longer tracked: the clearance keys of its agents must cover it, with keys not
/// later than `clear_until`.
struct ReleasedPair {
  AgentIndex lower, higher;
  Instant clear_until;
};

/// Tracks pairs, evaluates each when one of its agents has changed or when it is due, and reports
/// the result to the announcer. Pairs are evaluated in the order of their slots, which is the order
/// of events. A step costs O(pairs evaluated), plus a logarithm for each in the queue, plus a look
/// at each pair of a changed agent that does not wait already. When a pair that was an extreme of
/// its agent's pairs has changed, all of these are visited, at most once in a step.
///
/// A step evaluates no more pairs than its budget pays for (OwnerQueues says which). The others
/// wait: what was certified of them still holds, though newer states would tell more, and one that
/// may meet soon is announced. An evaluation that gets less than it wants leaves the rest
/// undecided.
///
/// A pair is due at every step while contact is possible within Δt, while it is to be announced, in
/// a contact that may end, and when an ended contact is settled. Beyond kPairsEvaluatedEachStep
/// tracked pairs a contact of two balls rests (contact_rest.h): it is not evaluated until it may
/// end, or for announce_within / 16 to announce_within / 8, depending on its slot, so that the
/// evaluations spread over the steps.
class TrackedPairs {
 public:
  static constexpr std::size_t kPairsEvaluatedEachStep = 512;
  /// Of the pairs that one owner pays for and that wait for their first evaluation, so many are
  /// announced in one step, the others as many in each temporal_resolution after it. Only the
  /// forecast is late: until then the clearances of the two end where they may first meet.
  static constexpr std::uint32_t kAnnouncedUnseen = 64;

  TrackedPairs(const DetectorOptions& options, const DetectorContext& context);

  /// The agent of this index is new.
  void AddAgent(AgentIndex agent);
  /// Forgets an agent that has left. Requires that it has no pairs.
  void ForgetAgent(AgentIndex agent);

  void SetShare(const OwnerId& owner, const Share& share) { table_.SetShare(owner, share); }

  const PairTable& table() const { return table_; }

  /// Tracks two agents that are certified free up to `free_until`. Returns false, and changes
  /// nothing, if there is no room. Unchecked: they are not tracked; Validate() finds it.
  [[nodiscard]] bool Track(AgentIndex a, AgentIndex b, Instant free_until, Past past);

  /// Freedom that was certified for the agent's pairs beyond `from` no longer holds.
  void RetractFree(AgentIndex agent, Instant from);
  /// A bound of the agent was broken: events published about its pairs may be void.
  void MarkBroken(AgentIndex agent, Instant last_honest);

  /// Starts a step's events, before anything else of that step.
  void StartStep();
  /// Evaluates the pairs of all agents that have changed, and those that are due, within the step's
  /// budget.
  void EvaluateDuePairs();
  /// The agent leaves or expires: evaluates its pairs a last time and tracks them no longer. Their
  /// owners pay out of their credit; the pairs beyond it end undecided.
  void EvaluateLastTime(AgentIndex agent, Departure departure);

  /// Pairs released since the last call, in the order of their release. The caller lowers the keys
  /// of both agents to cover them.
  std::vector<ReleasedPair> TakeReleased();
  /// Pairs that were added, evaluated or removed; the reader clears the set.
  IndexSet<PairSlot>* changed() { return &changed_; }

  /// What the agent's pairs say of it together. needed_from: they need none of its states from
  /// before it.
  const PairExtremes& ExtremesOf(AgentIndex agent) const {
    return extremes_.Of(agent, table_.Of(agent));
  }

  const std::vector<CollisionEvent>& events() const { return announcer_.events(); }
  std::size_t queued() const { return due_.size(); }
  /// Pairs whose freedom was taken back since the last step: each once, however often that was.
  std::size_t retracted() const { return retracted_.size(); }
  /// Pairs that wait for a later step, since the work of this one was used up.
  std::size_t waiting() const { return owners_.waiting(); }
  std::vector<OwnerWork> owner_work() const { return owners_.work(); }

  /// Walks the table and the queue, and compares them.
  void Validate() const;

 private:
  void QueueDuePairs();
  std::vector<PairSlot> RetractPostponed();
  void FindFirstClearance(PairSlot slot);
  void Announce(PairSlot slot);
  std::uint64_t TurnCostOf(PairSlot slot) const;
  WorkClaim ClaimOf(const PairTurn& turn) const;
  WorkClaim ClaimOf(PairSlot slot) const;
  void Evaluate(PairSlot slot, std::uint64_t allowed, Finality finality);
  PairInterest Report(PairSlot slot, const ContactTracker& preview, std::uint64_t allowed,
                      Finality finality);
  /// They have not met, and may within announce_within.
  bool MayMeetSoon(const ContactTracker& preview) const;
  EventFacts FactsOf(const PairRecord& pair, std::uint64_t allowed) const;
  void SetDue(PairSlot slot);
  Instant RestsUntil(PairSlot slot, const ContactTracker& preview) const;
  PairName NameOf(PairSlot slot) const;
  bool Release(PairSlot slot);
  void Drop(PairSlot slot, Departure departure);
  void Remove(PairSlot slot);
  void MarkChanged(PairSlot slot);
  PairExtremes ExtremesOf(const PairRecord& pair) const;

  const DetectorOptions options_;
  const DetectorContext context_;
  const PairQueries queries_;
  PairTable table_;
  AgentExtremes extremes_;
  PairEvaluator evaluator_;
  StepBudget budget_;
  OwnerQueues owners_;
  bool held_ = false;                // a pair could get less than it may need, in this step
  bool scarce_ = false;              // the last step's budget was used up, or nearly
  std::vector<PairSlot> retracted_;  // since the last step, each once
  std::vector<PairSlot> queued_;     // that began to wait or became due in this step
  Announcer announcer_;
  EventQueue<PairSlot> due_;  // by the time from which a pair is evaluated at every step
  std::vector<ReleasedPair> released_;
  IndexSet<PairSlot> changed_;
};

}  // namespace collision::detection
