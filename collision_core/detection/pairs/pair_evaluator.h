// What is known of one tracked pair: three horizons, evaluated one after the other.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/detection/agents/pair_queries.h"
#include "collision_core/detection/pairs/pair_table.h"

namespace collision::detection {

/// The agents of a pair in the order of their ids, and the record of the pair.
struct PairOfAgents {
  const AgentRecord& lower;
  const AgentRecord& higher;
  PairRecord& pair;
};

/// Evaluates a pair up to three horizons:
///  1. Settled, up to the older of the two newest states: horns of both directions hold, the
///     result is final. The evaluator waits for an agent's next state no longer than
///     LongestWaitFor(); then the time heard is final with the forward horn alone.
///  2. Heard, up to the time that both owners have reported: forward horns only, but no unknown
///     jump lies before. Contacts are confirmed up to here, and narrowed once settled.
///  3. Promised, beyond: freedom as long as both keep their newest bounds. Only freedom is claimed
///     here; a jump, breach or widening takes it back.
/// Where balls may meet soon, the narrow phase computes how long the shapes stay apart for all
/// motions within the newest bounds: ships that pass close by do not hold up the clock and are not
/// announced.
class PairEvaluator {
 public:
  explicit PairEvaluator(const DetectorContext& context)
      : clock_(context.clock), counters_(context.counters), queries_(context) {}

  /// Brings pair.tracker up to what is settled and returns a copy of it that runs ahead to the last
  /// horizon that holds. Requires that the two can meet. With Finality::kLast all is settled up to
  /// where neither has jumped; beyond, while both were there, no contact is certain, and nothing is
  /// promised.
  ContactTracker Evaluate(const PairOfAgents& agents, Finality finality, WorkBudget* work) const;

  /// How far Evaluate() settles a pair: nothing that comes later changes anything before.
  Instant SettledUntil(const PairOfAgents& agents, Finality finality) const;

  /// How long to wait for the agent's next state [s]: announce_within, or twice its last interval
  /// if that is longer.
  double LongestWaitFor(const AgentRecord& agent) const;

 private:
  Instant SettledUntil(const AgentRecord& agent) const;
  Instant BothThereUntil(const PairOfAgents& agents) const;
  Instant HeardUntil(const PairOfAgents& agents) const;
  void EvaluateUntil(const PairOfAgents& agents, Instant until, WorkBudget* work,
                     ContactTracker* tracker) const;
  void EvaluateUnheard(const PairOfAgents& agents, WorkBudget* work) const;
  void ExtendPromise(const PairOfAgents& agents, WorkBudget* work, ContactTracker* preview) const;

  const StepClock& clock_;
  DetectorCounters* counters_;
  const PairQueries queries_;
};

/// Updates ahead_from and ahead_until of the pair. States may lie ahead of `now`; then a contact or
/// a doubt is known before it begins.
void RecordContactAhead(const ContactTracker& preview, Instant now, PairRecord* pair);

}  // namespace collision::detection
