// What is known of one tracked pair: three horizons, evaluated one after the other.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/detection/agents/agent_record.h"
#include "collision_core/detection/detector_counters.h"
#include "collision_core/detection/pairs/pair_table.h"
#include "collision_core/detection/step_clock.h"

namespace collision::detection {

/// The agents of a pair in the order of their ids, and what is kept of it.
struct PairOfAgents {
  const AgentRecord& lower;
  const AgentRecord& higher;
  PairRecord& pair;
};

/// Evaluates a pair up to three horizons:
///  1. Settled, up to the older of the two newest states: horns of both directions hold, the
///     verdict is final. A state of an agent that speaks seldom is waited for no longer than
///     PatienceOf(); then what was heard of it is final with its forward horn alone.
///  2. Heard, up to what both owners have told: forward horns only, but no unknown jump lies
///     before. Contacts are confirmed up to here, and narrowed once settled.
///  3. Promised, beyond: freedom as long as both keep their newest bounds. Only freedom is claimed
///     here; a jump, breach or widening takes it back.
/// Where balls may meet soon, the shapes are asked how long they stay apart for all motions within
/// the newest bounds: ships that pass close by do not hold up the clock and are not announced.
class PairEvaluator {
 public:
  /// Both outlive the evaluator.
  PairEvaluator(const StepClock& clock, DetectorCounters* counters)
      : clock_(clock), counters_(counters) {}

  /// Brings pair.tracker up to what is settled and returns a copy of it that runs ahead to the last
  /// horizon that holds. Requires that the two can meet. With Finality::kLast all that was heard is settled, and nothing is
  /// promised.
  ContactTracker Evaluate(const PairOfAgents& agents, Finality finality, WorkBudget* work) const;

  /// No state of the agent is waited for longer than this [s]. An agent that speaks seldom, or
  /// once, is not waited for longer than twice its last interval.
  double PatienceOf(const AgentRecord& agent) const;

 private:
  Instant SettledUntil(const AgentRecord& agent) const;
  void EvaluateUntil(const PairOfAgents& agents, Instant until, WorkBudget* work,
                     ContactTracker* tracker) const;
  void ExtendPromise(const PairOfAgents& agents, WorkBudget* work, ContactTracker* preview) const;

  const StepClock& clock_;
  DetectorCounters* counters_;
};

/// States may reach beyond `now`: then a contact, or a doubt, is known before it begins. Updates
/// ahead_from and ahead_until.
void RecordContactAhead(const ContactTracker& preview, Instant now, PairRecord* pair);

}  // namespace collision::detection
