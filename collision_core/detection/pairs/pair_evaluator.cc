#include "collision_core/detection/pairs/pair_evaluator.h"

#include <algorithm>

#include "collision_core/detection/pairs/interval_evaluation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// How far ahead shapes are evaluated, in units of announce_within: a little beyond what the
// announcer takes for "far apart again".
constexpr double kLookAhead = 1.3;

// Shares of the work that is left in an evaluation: for the settled time, then for the heard time;
// the rest is for the promised time.
constexpr double kSettledShare = 0.5;
constexpr double kHeardShare = 0.8;

// Whether half of the freedom that was found at `looked` has passed: then it is computed again.
bool WearsOut(Instant looked, Instant now, Instant free_until) {
  if (looked == Instant::Always() || free_until <= now) return true;
  return free_until.nanoseconds() - now.nanoseconds() <= now.nanoseconds() - looked.nanoseconds();
}

Instant ExpiryOf(const PairOfAgents& agents) {
  return std::min(agents.lower.bound().state.expiry, agents.higher.bound().state.expiry);
}

}  // namespace

double PairEvaluator::LongestWaitFor(const AgentRecord& agent) const {
  return std::max(clock_.announce_within, 2 * agent.history.LastInterval());
}

Instant PairEvaluator::SettledUntil(const AgentRecord& agent) const {
  // It never moves: no state to come tells more.
  if (agent.is_half_space()) return agent.heard_until();
  return std::max(
      agent.stamp(),
      std::min(agent.heard_until(), numeric::AddRoundedDown(clock_.now, -LongestWaitFor(agent))));
}

Instant PairEvaluator::BothThereUntil(const PairOfAgents& agents) const {
  return std::min(clock_.now, ExpiryOf(agents));
}

Instant PairEvaluator::HeardUntil(const PairOfAgents& agents) const {
  return std::min(
      {agents.lower.heard_until(), agents.higher.heard_until(), BothThereUntil(agents)});
}

Instant PairEvaluator::SettledUntil(const PairOfAgents& agents, Finality finality) const {
  if (finality == Finality::kLast) {
    return std::min(
        {agents.lower.still_until(), agents.higher.still_until(), BothThereUntil(agents)});
  }
  return std::min({SettledUntil(agents.lower), SettledUntil(agents.higher), ExpiryOf(agents)});
}

void PairEvaluator::EvaluateUntil(const PairOfAgents& agents, Instant until, WorkBudget* work,
                                  ContactTracker* tracker) const {
  const SegmentCount count =
      EvaluateSegments(agents.lower.history, agents.higher.history, until, work, tracker);
  counters_->segments += count.segments;
  counters_->quick_segments += count.quick;
}

ContactTracker PairEvaluator::Evaluate(const PairOfAgents& agents, Finality finality,
                                       WorkBudget* work) const {
  CORE_CHECK(queries_.MayMeet(agents.pair.lower, agents.pair.higher), "only agents that can meet");
  const bool last = finality == Finality::kLast;
  {
    const WorkShare share(last ? 1 : kSettledShare, work);
    EvaluateUntil(agents, SettledUntil(agents, finality), work, &agents.pair.tracker);
  }
  if (last) EvaluateUnheard(agents, work);
  ContactTracker preview = agents.pair.tracker;
  preview.TakeFinished();
  {
    const WorkShare share(kHeardShare, work);
    EvaluateUntil(agents, HeardUntil(agents), work, &preview);
  }
  if (preview.free() && !last) ExtendPromise(agents, work, &preview);
  return preview;
}

// A contact at the last instant alone is no segment: of an agent that came or jumped then.
void PairEvaluator::EvaluateUnheard(const PairOfAgents& agents, WorkBudget* work) const {
  ContactTracker& tracker = agents.pair.tracker;
  if (!tracker.free()) return;
  const Instant until = BothThereUntil(agents);
  tracker.ConfirmNothing();
  EvaluateUntil(agents, until, work, &tracker);
  const bool begins = agents.lower.history.BeginsAt(until) || agents.higher.history.BeginsAt(until);
  if (!tracker.free() || tracker.at() != until || !begins) return;
  const Instant meet = queries_.EarliestOfWide(agents.pair.lower, agents.pair.higher, until);
  if (meet <= until) tracker.OpenAt(until);
}

void PairEvaluator::ExtendPromise(const PairOfAgents& agents, WorkBudget* work,
                                  ContactTracker* preview) const {
  const AgentRecord &a = agents.lower, &b = agents.higher;
  PairRecord& pair = agents.pair;
  const Instant there = ExpiryOf(agents);
  ContactTracker outlook = *preview;
  EvaluateUntil(agents, std::min(std::max(a.stamp(), b.stamp()), there), work, &outlook);
  if (!outlook.free() || outlook.finished().size() != preview->finished().size()) return;
  const Instant from = std::min(clock_.now, outlook.at());
  const Instant earliest = queries_.EarliestOf(pair.lower, pair.higher, from);
  if (from == clock_.now) {
    pair.canonical = earliest;
    pair.canonical_step = clock_.step;
  }
  outlook.ExtendFree(earliest);
  if (HaveKnownShapes(a.history, b.history) &&
      WearsOut(pair.looked_ahead, clock_.now, outlook.at())) {
    pair.looked_ahead = clock_.now;
    // Balls that overlap need not touch: look as far ahead as decides what is announced.
    const Instant ahead = numeric::AddRoundedDown(clock_.now, kLookAhead * clock_.announce_within);
    outlook.ExtendFree(
        ShapesFreeAhead(a.history, b.history, outlook.at(), std::min(ahead, there), work));
  }
  *preview = outlook;
  const bool free_throughout = pair.tracker.free() && preview->finished().empty();
  if (free_throughout) pair.tracker.ExtendFree(preview->at());
}

void RecordContactAhead(const ContactTracker& preview, Instant now, PairRecord* pair) {
  if (pair->ahead_until <= now) pair->ahead_from = pair->ahead_until = Instant::Never();
  for (const std::vector<ContactEpisode>* episodes :
       {&pair->tracker.finished(), &preview.finished()}) {
    for (const ContactEpisode& episode : *episodes) {
      if (episode.end.latest <= now || pair->ahead_from <= episode.begin.earliest) continue;
      pair->ahead_from = episode.begin.earliest;
      pair->ahead_until = episode.end.latest;
    }
  }
}

}  // namespace collision::detection
