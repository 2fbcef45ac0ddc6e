#include "collision_core/detection/pairs/tracked_pairs.h"

#include <algorithm>
#include <map>
#include <utility>

#include "collision_core/detection/encounter/closest_so_far.h"
#include "collision_core/detection/pairs/contact_rest.h"
#include "collision_core/detection/pairs/interval_evaluation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// Weights of a pair, beside 1 for one that is not announced, when a step's work is shared out: a
// possible event waits for its outcome, a contact for its end.
constexpr std::uint32_t kDoubtWeight = 4;
constexpr std::uint32_t kContactWeight = 2;

// A pair claims twice what its last evaluation took and this part of all it may spend, for what may
// have changed since; all of it where the last one took more than a quarter.
constexpr std::uint64_t kClaimMore = 16;
constexpr std::uint64_t kClaimAll = 4;

// Work is plentiful again once a step has spent less than this part of its budget.
constexpr std::uint64_t kPlenty = 2;

// Parts of an evaluation's work that are allowed beside what the evaluation took: for the proximity
// of a contact that is confirmed, for what is expected of a pair, for its closest approach.
constexpr std::uint64_t kProximityShare = 8;
constexpr std::uint64_t kExpectedShare = 8;
constexpr std::uint64_t kClosestShare = 8;

// How far ahead a pair is expected to keep its motion, in units of announce_within: a possible
// contact is announced at its earliest, and mostly comes later.
constexpr double kExpectedAhead = 2;

// What a turn costs of a step's work, in units. Two shapes cost as much as their last evaluation
// took, within these bounds, so that a step has several turns; at first, enough to tell something.
// Two balls cost this much for each state that is new to them.
constexpr std::uint64_t kShapesFirstTurn = 1000;
constexpr std::uint64_t kShapesTurnMin = 100;
constexpr std::uint64_t kTurnsPerStep = 16;
constexpr std::uint64_t kBallsTurn = 20;

// A contact that cannot end is evaluated again after at most this share of announce_within, each
// pair after another part of the share's second half.
constexpr double kRestShare = 0.125;
constexpr std::uint32_t kRestTimes = 16;

}  // namespace

TrackedPairs::TrackedPairs(const DetectorOptions& options, const DetectorContext& context)
    : options_(options),
      context_(context),
      queries_(context),
      table_(options.pairs_max, options.pairs_per_agent_max),
      evaluator_(context),
      budget_(options.work_units_per_evaluation, options.work_units_per_step),
      owners_(options.temporal_resolution, options.work_units_per_slice),
      announcer_(options, context.counters) {}

void TrackedPairs::AddAgent(AgentIndex agent) {
  const AgentRecord& record = context_.agents[agent];
  table_.AddAgent(agent, OwnerOf(record.id), record.is_half_space());
  extremes_.AddAgent(agent);
}

void TrackedPairs::ForgetAgent(AgentIndex agent) {
  table_.RemoveAgent(agent);
  announcer_.Forget(agent);
}

bool TrackedPairs::Track(AgentIndex a, AgentIndex b, Instant free_until, Past past) {
  const AgentTable& agents = context_.agents;
  const auto [lower, higher] = agents[a].id < agents[b].id ? std::pair(a, b) : std::pair(b, a);
  if (table_.RoomFor(a) == 0 || table_.RoomFor(b) == 0) return false;
  const PairSlot slot = table_.Add({.lower = lower,
                                    .higher = higher,
                                    .tracker = ContactTracker(free_until, past),
                                    .clear_until = free_until});
  owners_.AddPair(slot, OwnerOf(agents[lower].id), OwnerOf(agents[higher].id));
  MarkChanged(slot);
  SetDue(slot);
  return true;
}

void TrackedPairs::RetractFree(AgentIndex agent, Instant from) {
  for (const PairSlot slot : table_.Of(agent)) {
    PairRecord& pair = table_[slot];
    pair.tracker.RetractFree(from, Past::kKnown);
    extremes_.Set(slot, pair.lower, pair.higher, ExtremesOf(pair));
    if (pair.retracted_from.is_never()) retracted_.push_back(slot);
    pair.retracted_from = std::min(pair.retracted_from, from);
  }
}

// What lies between the last honest state and the breach is unknown.
void TrackedPairs::MarkBroken(AgentIndex agent, Instant last_honest) {
  RetractFree(agent, last_honest);
  for (const PairSlot slot : table_.Of(agent)) table_[slot].published.broken = true;
}

void TrackedPairs::StartStep() { announcer_.Start(context_.clock.now); }

void TrackedPairs::EvaluateDuePairs() {
  QueueDuePairs();
  const bool limited = budget_.is_limited();
  const auto cost = [&](PairSlot slot) { return limited ? TurnCostOf(slot) : 0; };
  const std::vector<PairTurn> turns =
      owners_.Take(limited ? budget_.per_step() : 0, cost, context_.clock.now,
                   !context_.agents.changed().empty());
  const std::vector<PairSlot> unannounced = RetractPostponed();
  if (limited) {
    std::vector<PairClaim> claims;
    for (const PairTurn& turn : turns) {
      claims.push_back({ClaimOf(turn), turn.payer, turn.payer_units});
    }
    budget_.Start(claims);
  }
  held_ = false;
  const std::uint64_t at_start = context_.counters->work_units;
  // Pairs by slot, which is the order of events.
  auto postponed = unannounced.begin();
  for (const PairTurn& turn : turns) {
    for (; postponed != unannounced.end() && *postponed < turn.slot; ++postponed) {
      Announce(*postponed);
    }
    table_.SetIdle(turn.slot);
    const std::uint64_t before = context_.counters->work_units;
    Evaluate(turn.slot, limited ? budget_.Allowed() : options_.work_units_per_evaluation,
             Finality::kOngoing);
    const std::uint64_t units = context_.counters->work_units - before;
    if (limited) budget_.Spent(units);
    owners_.RecordEvaluation(turn, units);
    context_.clock.MadeProgress();
  }
  for (; postponed != unannounced.end(); ++postponed) Announce(*postponed);
  scarce_ = held_ && context_.counters->work_units - at_start > budget_.per_step() / kPlenty;
}

// All pairs of changed agents, and those that are due. Pairs that are not idle wait already.
void TrackedPairs::QueueDuePairs() {
  queued_.clear();
  for (const AgentIndex agent : context_.agents.changed()) {
    if (!context_.agents.Contains(agent)) continue;
    for (const PairSlot slot : table_.TakeIdle(agent)) {
      if (owners_.Wait(slot)) queued_.push_back(slot);
    }
  }
  while (!due_.empty() && due_.top_key() <= context_.clock.now) {
    const PairSlot slot = due_.top();
    due_.Set(slot, Instant::Never());
    owners_.Wait(slot);
    queued_.push_back(slot);
  }
}

// What was certified of the pairs that wait for a later step still holds, unless an agent was
// renewed. Returns those that must be announced meanwhile, by slot.
std::vector<PairSlot> TrackedPairs::RetractPostponed() {
  for (const PairSlot slot : retracted_) {
    if (!table_.Contains(slot)) continue;
    PairRecord& pair = table_[slot];
    const Instant from = std::exchange(pair.retracted_from, Instant::Never());
    if (!owners_.IsWaiting(slot)) continue;
    pair.clear_until = std::min(pair.clear_until, from);
    MarkChanged(slot);
    queued_.push_back(slot);
  }
  retracted_.clear();
  std::sort(queued_.begin(), queued_.end());
  queued_.erase(std::unique(queued_.begin(), queued_.end()), queued_.end());
  std::map<OwnerId, std::uint32_t> announced;
  std::vector<PairSlot> unannounced;
  for (const PairSlot slot : queued_) {
    if (!owners_.IsWaiting(slot) || table_[slot].published.announced) continue;
    FindFirstClearance(slot);
    const Instant announce =
        numeric::AddRoundedUp(table_[slot].clear_until, -options_.announce_within);
    due_.Set(slot, announce);
    if (announce > context_.clock.now) continue;
    const std::uint32_t later = announced[owners_.PayerOf(slot)]++ / kAnnouncedUnseen;
    if (later == 0) {
      unannounced.push_back(slot);
    } else {
      due_.Set(slot,
               numeric::AddRoundedUp(context_.clock.now, later * options_.temporal_resolution));
    }
  }
  return unannounced;
}

// Until the first evaluation the balls alone tell until when two agents are clear.
void TrackedPairs::FindFirstClearance(PairSlot slot) {
  PairRecord& pair = table_[slot];
  const Instant newest =
      std::max(context_.agents[pair.lower].stamp(), context_.agents[pair.higher].stamp());
  if (pair.evaluated_step != 0 || pair.tracker.at() < newest) return;
  const Instant from = std::min(context_.clock.now, pair.tracker.at());
  pair.tracker.ExtendFree(queries_.EarliestOf(pair.lower, pair.higher, from));
  pair.clear_until = pair.tracker.at();
  MarkChanged(slot);
}

// A pair that waits may meet soon.
void TrackedPairs::Announce(PairSlot slot) {
  PairRecord& pair = table_[slot];
  due_.Set(slot, Instant::Never());
  EventFacts facts = FactsOf(pair, options_.work_units_per_evaluation);
  announcer_.Announce(NameOf(slot), pair.clear_until, pair.tracker.began_before(), &facts,
                      &pair.published);
  MarkChanged(slot);
}

// What the pair is expected to spend if it is evaluated in this step.
std::uint64_t TrackedPairs::TurnCostOf(PairSlot slot) const {
  const PairRecord& pair = table_[slot];
  const History &a = context_.agents[pair.lower].history, &b = context_.agents[pair.higher].history;
  if (!HaveKnownShapes(a, b)) {
    const Instant at = pair.tracker.at();
    return kBallsTurn * (1 + a.CountAfter(at) + b.CountAfter(at));
  }
  const std::uint64_t most =
      std::min(budget_.per_step() / kTurnsPerStep, options_.work_units_per_evaluation);
  if (pair.evaluated_step == 0) return kShapesFirstTurn;
  return std::max(kShapesTurnMin, std::min(pair.spent, most));
}

// While work is plentiful each pair claims no more than it is expected to spend. All that is left
// is there for those that need more, and a budget that is not used up limits none. Once work is
// scarce the first ones would use up what is left: then each pair claims what it may need, and is
// sure of its share.
WorkClaim TrackedPairs::ClaimOf(const PairTurn& turn) const {
  WorkClaim claim = ClaimOf(turn.slot);
  if (owners_.waiting() == 0 && !scarce_) claim.wanted = std::min(claim.wanted, turn.cost);
  return claim;
}

WorkClaim TrackedPairs::ClaimOf(PairSlot slot) const {
  const PairRecord& pair = table_[slot];
  WorkClaim claim;
  if (!HaveKnownShapes(context_.agents[pair.lower].history, context_.agents[pair.higher].history)) {
    return claim;
  }
  claim.wanted = options_.work_units_per_evaluation;
  if (pair.spent < claim.wanted / kClaimAll) {
    claim.wanted = 2 * pair.spent + claim.wanted / kClaimMore;
  }
  if (pair.published.announced) claim.weight = pair.in_contact ? kContactWeight : kDoubtWeight;
  return claim;
}

bool TrackedPairs::MayMeetSoon(const ContactTracker& preview) const {
  const Instant soon = numeric::AddRoundedDown(context_.clock.now, options_.announce_within);
  return preview.free() && preview.finished().empty() && preview.free_until() <= soon;
}

void TrackedPairs::Evaluate(PairSlot slot, std::uint64_t allowed, Finality finality) {
  PairRecord& pair = table_[slot];
  const AgentRecord &a = context_.agents[pair.lower], &b = context_.agents[pair.higher];
  if (!queries_.MayMeet(pair.lower, pair.higher)) return Drop(slot, Departure::kUnwatched);
  // One budget for all horizons, what is settled first.
  const bool held = allowed < ClaimOf(slot).wanted;
  held_ = held_ || held;
  WorkBudget work(allowed, held ? WhenExhausted::kLeaveUndecided : WhenExhausted::kQueryOnce);
  const ContactTracker preview = evaluator_.Evaluate({a, b, pair}, finality, &work);
  if (pair.published.announced) {
    // Whatever closes the event wants it to the end.
    const bool approaching = finality == Finality::kOngoing && MayMeetSoon(preview);
    const FollowLimits limits{evaluator_.SettledUntil({a, b, pair}, finality), approaching,
                              allowed / kClosestShare};
    context_.counters->encounter_units +=
        FollowClosest(a.history, b.history, limits, &pair.published);
  }
  pair.published.work += work.spent();
  pair.spent = work.exhausted() ? kAllWanted : work.spent();
  context_.counters->work_units += work.spent();
  context_.counters->evaluations_cut_short += work.exhausted();
  RecordContactAhead(preview, context_.clock.now, &pair);
  pair.in_contact = preview.in_contact();
  pair.clear_until = preview.free_until();
  const std::vector<ContactEpisode>& heard = preview.finished();
  pair.settles = heard.empty() ? Instant::Never()
                               : numeric::AddRoundedUp(heard.front().end.latest,
                                                       std::max(evaluator_.LongestWaitFor(a),
                                                                evaluator_.LongestWaitFor(b)));
  pair.unsettled_until = heard.empty() ? Instant::Always() : heard.back().end.latest;
  pair.evaluated_step = context_.clock.step;
  const PairInterest interest = Report(slot, preview, allowed, finality);
  MarkChanged(slot);
  if (interest == PairInterest::kFarApart && Release(slot)) return;
  if (pair.in_contact) pair.rests_until = RestsUntil(slot, preview);
  SetDue(slot);
}

PairInterest TrackedPairs::Report(PairSlot slot, const ContactTracker& preview,
                                  std::uint64_t allowed, Finality finality) {
  PairRecord& pair = table_[slot];
  EventFacts facts = FactsOf(pair, allowed);
  std::vector<ContactEpisode> settled;
  const PairOutlook outlook = OutlookOf(&pair.tracker, preview, &settled);
  return announcer_.Report(NameOf(slot), outlook, finality, &facts, &pair.published);
}

EventFacts TrackedPairs::FactsOf(const PairRecord& pair, std::uint64_t allowed) const {
  const FactLimits limits{.now = context_.clock.now,
                          .ahead = kExpectedAhead * options_.announce_within,
                          .proximity_units = allowed / kProximityShare,
                          .expected_units = allowed / kExpectedShare};
  return {context_.agents[pair.lower], context_.agents[pair.higher], limits, context_.counters};
}

void TrackedPairs::SetDue(PairSlot slot) {
  const PairRecord& pair = table_[slot];
  const bool announced = pair.published.announced;
  const double ahead = announced ? options_.temporal_resolution : options_.announce_within;
  // Rounded as now + ahead is: clear_until <= now + ahead exactly if due <= now.
  const Instant due = std::min(numeric::AddRoundedUp(pair.clear_until, -ahead), pair.settles);
  due_.Set(slot, pair.in_contact ? pair.rests_until : due);
}

Instant TrackedPairs::RestsUntil(PairSlot slot, const ContactTracker& preview) const {
  if (table_.size() <= kPairsEvaluatedEachStep) return Instant::Always();
  const PairRecord& pair = table_[slot];
  const double part = static_cast<double>(slot.value() % kRestTimes) / kRestTimes;
  const double longest = kRestShare * options_.announce_within * (1 + part) / 2;
  return ContactRestsUntil({context_.agents[pair.lower].history.newest(),
                            context_.agents[pair.higher].history.newest(), pair.tracker, preview},
                           context_.clock.now, longest);
}

PairName TrackedPairs::NameOf(PairSlot slot) const {
  const PairRecord& pair = table_[slot];
  const AgentRecord &lower = context_.agents[pair.lower], &higher = context_.agents[pair.higher];
  return {.lower = lower.id,
          .higher = higher.id,
          .lower_index = pair.lower,
          .higher_index = pair.higher,
          .slot = slot,
          .margin = lower.declaration.margin + higher.declaration.margin,
          .size = lower.declaration.limits.radius + higher.declaration.limits.radius,
          .lower_side = lower.declaration.filter.side,
          .higher_side = higher.declaration.filter.side};
}

// Both keys cover the pair from now on. False: they cannot, since a state lies beyond what is
// certain of the two, or since the two graze each other and may meet soon under the wider bounds
// that keys come from.
bool TrackedPairs::Release(PairSlot slot) {
  const PairRecord& pair = table_[slot];
  const AgentRecord &a = context_.agents[pair.lower], &b = context_.agents[pair.higher];
  Instant key = pair.clear_until;
  if (!HaveKnownShapes(a.history, b.history)) {
    key = std::min(key, queries_.EarliestOfWide(pair.lower, pair.higher, context_.clock.now));
  }
  if (key <= context_.clock.announce_until() || key < std::max(a.stamp(), b.stamp())) return false;
  released_.push_back({pair.lower, pair.higher, key});
  Remove(slot);
  return true;
}

void TrackedPairs::EvaluateLastTime(AgentIndex agent, Departure departure) {
  const std::vector<PairSlot> slots = table_.Of(agent);
  for (const PairSlot slot : slots) {
    const OwnerId payer = owners_.PayerOf(slot);
    const std::uint64_t before = context_.counters->work_units;
    std::uint64_t allowed = options_.work_units_per_evaluation;
    if (budget_.is_limited()) {
      allowed = std::min(allowed, owners_.CreditOf(payer, budget_.per_step(), context_.clock.now));
    }
    Evaluate(slot, allowed, Finality::kLast);
    owners_.Charge(payer, context_.counters->work_units - before);
    if (table_.Contains(slot)) Drop(slot, departure);
    context_.clock.MadeProgress();
  }
}

// The two are no longer watched: closes their event and releases the slot.
void TrackedPairs::Drop(PairSlot slot, Departure departure) {
  PairRecord& pair = table_[slot];
  const ContactEpisode* open = pair.tracker.free() ? nullptr : &pair.tracker.episode();
  const AgentTable& agents = context_.agents;
  const Instant until = std::min(
      {agents[pair.lower].gone_from(), agents[pair.higher].gone_from(), context_.clock.now});
  announcer_.Close(NameOf(slot), open, departure, until, &pair.published);
  Remove(slot);
}

void TrackedPairs::Remove(PairSlot slot) {
  MarkChanged(slot);
  extremes_.Set(slot, table_[slot].lower, table_[slot].higher, PairExtremes());
  due_.Remove(slot);
  owners_.RemovePair(slot);
  table_.Remove(slot);
}

// After the change.
void TrackedPairs::MarkChanged(PairSlot slot) {
  const PairRecord& pair = table_[slot];
  changed_.Insert(slot);
  extremes_.Set(slot, pair.lower, pair.higher, ExtremesOf(pair));
  context_.clearances_dirty->Insert(pair.lower);
  context_.clearances_dirty->Insert(pair.higher);
}

PairExtremes TrackedPairs::ExtremesOf(const PairRecord& pair) const {
  return {.clear_until = pair.in_contact ? Instant::Never() : pair.clear_until,
          .unannounced_until = pair.published.announced ? Instant::Never() : pair.clear_until,
          .needed_from = pair.published.announced
                             ? std::min(pair.tracker.at(), pair.published.followed_until)
                             : pair.tracker.at(),
          .unsettled_until = pair.unsettled_until,
          .contacts = pair.in_contact};
}

std::vector<ReleasedPair> TrackedPairs::TakeReleased() { return std::exchange(released_, {}); }

void TrackedPairs::Validate() const {
  table_.Validate();
  due_.Validate();
  changed_.Validate();
  announcer_.Validate();
  owners_.Validate();
  CORE_CHECK(due_.size() == table_.size(), "each tracked pair is queued", due_.size(),
             table_.size());
  for (std::size_t agent = 0; agent < context_.agents.index_end(); ++agent) {
    if (!context_.agents.Contains(AgentIndex(agent))) continue;
    extremes_.Validate(AgentIndex(agent), table_.Of(AgentIndex(agent)));
    for (const PairSlot slot : table_.Of(AgentIndex(agent))) {
      const PairRecord& pair = table_[slot];
      const AgentIndex partner = pair.PartnerOf(AgentIndex(agent));
      CORE_CHECK(due_.Contains(slot), "a tracked pair is queued", slot.value());
      CORE_CHECK(extremes_.OfPair(slot) == ExtremesOf(pair), "what a pair says is up to date",
                 slot.value());
      CORE_CHECK(context_.agents.Contains(partner), "a tracked pair has two agents", slot.value());
      CORE_CHECK(!context_.agents[partner].expired, "no agent of a tracked pair has expired",
                 slot.value());
      CORE_CHECK(context_.agents[pair.lower].id < context_.agents[pair.higher].id,
                 "a pair's agents are in the order of their ids", slot.value());
    }
  }
}

}  // namespace collision::detection
