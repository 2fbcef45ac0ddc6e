#include "collision_core/detection/earliest/earliest_search.h"

#include <algorithm>
#include <tuple>

#include "collision_core/detection/pairs/interval_evaluation.h"
#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// Lower bounds come from the canonical routine as well, evaluated from an earlier time, and its
/// answers are early by up to 1e-9 of the way: from now on perhaps by nothing, then by all of that.
/// A pair whose lower bound is `bound` meets, at the latest, by bound + 1e-9 / (1 - 1e-9) of the
/// way and 1 ns for the rounding, so that its lower bound is not later than this. What the rounding
/// of the inputs forces beyond that, the margin in the lower bounds covers (BoundMargin).
Instant MeetsBy(Instant now, Instant bound) {
  constexpr double kEarliness = 0x1p-29;
  constexpr double kInstantRounding = 2e-9;
  if (bound.is_never() || bound <= now) return bound;
  return numeric::AddRoundedUp(
      bound, kEarliness * numeric::SecondsBetween(now, bound).upper + kInstantRounding);
}

/// The earliest bound that can be known of a pair: Always() stands for a bound that is not known.
constexpr Instant kEarliestBound = Instant::FromNanoseconds(Instant::Always().nanoseconds() + 1);

}  // namespace

struct EarliestSearch::Run {
  const AgentTable& agents;
  Instant now;
  std::size_t queries_left;
  EarliestAnswer best{};
  std::vector<Taken<PairSlot>> pairs{};
  std::vector<Taken<AgentIndex>> taken{};

  void Offer(AgentIndex a, AgentIndex b, Instant when) {
    if (when.is_never()) return;
    const auto [lower, higher] = std::minmax(agents[a].id, agents[b].id);
    if (best.found &&
        std::tie(best.earliest, best.lower, best.higher) <= std::tie(when, lower, higher)) {
      return;
    }
    best = {true, when, lower, higher};
  }

  /// What has a later lower bound does not better the best answer.
  Instant Limit() const { return MeetsBy(now, best.earliest); }

  void CountQuery() {
    if (queries_left > 0) --queries_left;
  }

  template <typename IndexType>
  bool MayBetter(const EventQueue<IndexType>& queue) const {
    return !queue.empty() && queue.top_key() <= Limit() && !queue.top_key().is_never();
  }
};

EarliestSearch::EarliestSearch(const DetectorContext& context, TrackedPairs* pairs,
                               Clearances* clearances)
    : context_(context),
      queries_(context),
      pairs_(pairs->table()),
      coverage_(clearances->coverage()),
      pairs_changed_(pairs->changed()),
      agents_voided_(clearances->voided()),
      broad_phase_(clearances->broad_phase()),
      next_(clearances->broad_phase(), coverage_.tiers(), context.clock),
      uncovered_(context, coverage_, clearances->broad_phase(), clearances->former()) {}

EarliestAnswer EarliestSearch::Find(std::size_t queries_max) {
  TakeChanges();
  Run run{.agents = context_.agents, .now = context_.clock.now, .queries_left = queries_max};
  OfferSaturated(&run);
  OfferPairs(&run);
  OfferAgents(&run);
  for (const auto& [slot, bound] : run.pairs) pair_bounds_.Set(slot, bound);
  for (const auto& [agent, bound] : run.taken) agent_bounds_.Set(agent, bound);
  return run.best;
}

// Nothing is known of pairs and agents that have changed since the last query.
void EarliestSearch::TakeChanges() {
  for (const PairSlot slot : *pairs_changed_) {
    if (!pair_answers_.contains(slot)) pair_answers_.resize(slot.value() + 1);
    pair_answers_[slot] = PairLowerBound();
    if (pairs_.Contains(slot) && !pairs_[slot].in_contact) {
      pair_bounds_.Set(slot, Instant::Always());
    } else {
      pair_bounds_.Remove(slot);
    }
  }
  pairs_changed_->Clear();
  for (const AgentIndex agent : *agents_voided_) {
    if (!agents_.contains(agent)) agents_.resize(agent.value() + 1);
    if (context_.agents.Contains(agent) && !context_.agents[agent].expired) {
      agent_bounds_.Set(agent, Instant::Always());
    } else {
      agent_bounds_.Remove(agent);
    }
  }
  agents_voided_->Clear();
}

// A saturated agent may touch at any time.
void EarliestSearch::OfferSaturated(Run* run) const {
  for (const AgentIndex agent : coverage_.saturated()) {
    if (context_.agents[agent].expired) continue;
    const AgentIndex partner = coverage_[agent].crowded_with;
    run->Offer(agent, context_.agents.Contains(partner) ? partner : agent, run->now);
  }
}

void EarliestSearch::OfferPairs(Run* run) {
  while (run->MayBetter(pair_bounds_)) {
    const PairSlot slot = pair_bounds_.top();
    const Instant bound = pair_bounds_.top_key();
    // The canonical answer of a pair that was evaluated in this step is known; of the others first
    // a lower bound.
    const bool known = pairs_[slot].evaluated_step == context_.clock.step;
    if (!known && bound == Instant::Always()) {
      pair_bounds_.Set(slot, LowerBoundOf(pairs_[slot]));
      continue;
    }
    if (!known && run->queries_left == 0) {
      return run->Offer(pairs_[slot].lower, pairs_[slot].higher, std::max(run->now, bound));
    }
    pair_bounds_.Remove(slot);
    run->pairs.push_back({slot, bound});
    OfferPair(slot, run);
  }
}

void EarliestSearch::OfferPair(PairSlot slot, Run* run) {
  const AgentTable& agents = context_.agents;
  const PairRecord& pair = pairs_[slot];
  const std::uint64_t step = context_.clock.step;
  PairLowerBound& answer = pair_answers_.at(slot);
  if (answer.canonical_step != step) {
    const bool known = pair.canonical_step == step;
    answer = {step, known ? pair.canonical : Canonical(pair.lower, pair.higher, run)};
  }
  // A contact may begin and end before states that lie ahead.
  if (!pair.ahead_from.is_never() && pair.ahead_until > run->now) {
    run->Offer(pair.lower, pair.higher, std::max(run->now, pair.ahead_from));
  }
  // The canonical answer begins at the newer state. Where that lies ahead of now (its owner was
  // granted more time than others), the pair must be certified free until there.
  const Instant known_from = std::max(agents[pair.lower].stamp(), agents[pair.higher].stamp());
  if (pair.clear_until < known_from) {
    const Instant clear_until = std::max(run->now, pair.clear_until);
    return run->Offer(pair.lower, pair.higher, std::min(answer.canonical, clear_until));
  }
  // Where balls may overlap, their shapes may be certified apart for longer. (Of balls, what an
  // older state certified could only be later by its rounding.)
  const bool shaped = HaveKnownShapes(agents[pair.lower].history, agents[pair.higher].history);
  run->Offer(pair.lower, pair.higher,
             shaped ? std::max(answer.canonical, pair.clear_until) : answer.canonical);
}

// A lower bound of all that OfferPair() may offer until the pair is evaluated again.
Instant EarliestSearch::LowerBoundOf(const PairRecord& pair) const {
  const AgentRecord &a = context_.agents[pair.lower], &b = context_.agents[pair.higher];
  const auto wide = [](const AgentRecord& agent) -> broad_phase::AgentBound {
    return {BoundMargin(agent.bound()).Widen(agent.bound()), agent.declaration.filter};
  };
  const broad_phase::AgentBound of_a = wide(a), of_b = wide(b);
  Instant bound =
      queries_.EarliestUnder({pair.lower, of_a}, {pair.higher, of_b}, context_.clock.now);
  if (pair.clear_until < std::max(a.stamp(), b.stamp())) bound = std::min(bound, pair.clear_until);
  return std::max(kEarliestBound, std::min(bound, pair.ahead_from));
}

void EarliestSearch::OfferAgents(Run* run) {
  while (run->MayBetter(agent_bounds_)) {
    const AgentIndex agent = agent_bounds_.top();
    const Instant bound = agent_bounds_.top_key();
    const AgentCoverage& record = coverage_[agent];
    const bool saturated = coverage_.IsSaturated(agent);
    if (!saturated && bound == Instant::Always() && !IsUncovered(agent)) {
      agents_[agent] = {record.queried_step, record.next_partner};
      agent_bounds_.Set(agent, std::max(kEarliestBound, record.keys.earliest()));
      continue;
    }
    if (!saturated && run->queries_left == 0) return OfferBound(agent, bound, run);
    if (!saturated && bound != Instant::Always() &&
        agents_[agent].computed_step != context_.clock.step) {
      ComputeBound(agent, run);
      continue;
    }
    agent_bounds_.Remove(agent);
    run->taken.push_back({agent, bound});
    if (saturated) continue;
    if (bound == Instant::Always()) OfferUncovered(agent, run);
    OfferPartners(agent, std::max(bound, record.keys.earliest()), run);
  }
}

// The agent is certified clear of its partners only up to before its newest state.
bool EarliestSearch::IsUncovered(AgentIndex agent) const {
  const AgentCoverage& record = coverage_[agent];
  return record.renewed_from || record.keys.earliest() < context_.agents[agent].stamp();
}

// After a step, only an agent that is uncovered may meet one that it is not tracked with by
// announce_until.
void EarliestSearch::OfferBound(AgentIndex agent, Instant bound, Run* run) const {
  const AgentTable& agents = context_.agents;
  const AgentIndex next = agents_[agent].next_partner;
  if (bound == Instant::Always()) return run->Offer(agent, agent, run->now);
  const bool known = next != agent && agents.Contains(next) && !agents[next].expired &&
                     queries_.MayMeet(agent, next);
  run->Offer(agent, known ? next : agent, std::max(context_.clock.announce_until(), bound));
}

void EarliestSearch::OfferUncovered(AgentIndex agent, Run* run) {
  const AgentCoverage& record = coverage_[agent];
  agents_[agent].next_partner = record.next_partner;
  PartnerMarks& tracked = TrackedWith(agent);
  const Instant covered =
      std::min(record.keys.earliest(), record.renewed_from.value_or(Instant::Never()));
  const std::vector<UncoveredPartner>& partners =
      uncovered_.Find({.agent = agent,
                       .from = std::min(run->now, covered),
                       .covered = covered,
                       .renewed = record.renewed_from.has_value(),
                       .tracked = &tracked});
  for (const UncoveredPartner& partner : partners) {
    const Instant free_until = std::max(run->now, partner.free_until);
    const Instant canonical = Canonical(agent, partner.partner, run);
    run->Offer(agent, partner.partner, std::min(canonical, free_until));
  }
}

// All untracked partners that may be met by announce_until were tracked in the last step.
void EarliestSearch::ComputeBound(AgentIndex agent, Run* run) {
  ++context_.counters->queries;
  run->CountQuery();
  PartnerMarks& tracked = TrackedWith(agent);
  const Instant now = context_.clock.now;
  const NextNeighbour next =
      next_.Find({.agent = agent, .from = now, .covered = now, .tracked = &tracked},
                 context_.clock.announce_until());
  agents_[agent] = {context_.clock.step, next.partner};
  agent_bounds_.Set(agent, std::max(kEarliestBound, next.when));
}

PartnerMarks& EarliestSearch::TrackedWith(AgentIndex agent) {
  tracked_memory_.Start(agent, pairs_, context_.agents.index_end());
  return tracked_memory_;
}

// The bound is computed from wide bounds, which cannot tell which of several partners comes first.
void EarliestSearch::OfferPartners(AgentIndex agent, Instant bound, Run* run) {
  PartnerMarks& tracked = TrackedWith(agent);
  const AgentTable& agents = context_.agents;
  const AgentIndex next = agents_[agent].next_partner;
  if (next != agent && agents.Contains(next) && !agents[next].expired && !tracked.Contains(next)) {
    run->Offer(agent, next, Canonical(agent, next, run));
  }
  if (!run->best.found) OfferNeighbours(agent, {run->now, bound, Instant::Never()}, tracked, run);
  OfferNeighbours(agent, {run->now, run->Limit(), run->Limit()}, tracked, run);
}

Instant EarliestSearch::Canonical(AgentIndex a, AgentIndex b, Run* run) const {
  run->CountQuery();
  return queries_.EarliestOf(a, b, context_.clock.now);
}

void EarliestSearch::OfferNeighbours(AgentIndex agent, const broad_phase::NeighbourWindow& window,
                                     const PartnerMarks& tracked, Run* run) {
  found_memory_.clear();
  const auto skip = [&tracked](std::uint32_t partner) {
    return tracked.Contains(AgentIndex(partner));
  };
  broad_phase_->FindNeighbours(agent.value(), window, skip, &found_memory_);
  for (const broad_phase::Neighbour& neighbour : found_memory_) {
    const AgentIndex partner(neighbour.partner);
    run->Offer(agent, partner, Canonical(agent, partner, run));
  }
}

void EarliestSearch::Validate() const {
  agent_bounds_.Validate();
  pair_bounds_.Validate();
  for (std::size_t k = 0; k < context_.agents.index_end(); ++k) {
    const AgentIndex agent(k);
    if (!context_.agents.Contains(agent) || agents_voided_->Contains(agent)) continue;
    CORE_CHECK(agent_bounds_.Contains(agent) != context_.agents[agent].expired,
               "an agent has a lower bound unless it has expired", k);
    for (const PairSlot slot : pairs_.Of(agent)) {
      CORE_CHECK(
          pairs_changed_->Contains(slot) || pair_bounds_.Contains(slot) != pairs_[slot].in_contact,
          "a tracked pair has a lower bound unless it is in contact", slot.value());
    }
  }
}

}  // namespace collision::detection
