#include "collision_core/detection/clearance/clearance_queries.h"

#include <algorithm>

namespace collision::detection {
namespace {

/// Beyond so many renewed agents at once, those with far keys are asked about anew: to look at each
/// such key for each renewed agent would cost more.
constexpr std::size_t kManyRenewed = 4096;

/// Keys beyond this horizon are far.
constexpr int kFarHorizon = 4;

/// Beyond this horizon a question looks for the next meeting alone.
constexpr int kHorizonNear = 4;

}  // namespace

ClearanceQueries::ClearanceQueries(const DetectorContext& context, const QueryTargets& targets)
    : context_(context),
      coverage_(*targets.coverage),
      told_(*targets.told),
      pairs_(*targets.pairs),
      uncovered_(context, coverage_, targets.broad_phase, targets.former),
      due_(targets.broad_phase, coverage_.tiers(), pairs_.table(), context.clock),
      next_(targets.broad_phase, coverage_.tiers(), context.clock),
      lowering_(context, targets.coverage, targets.told, targets.broad_phase, targets.filter) {}

void ClearanceQueries::QueryDueAgents() {
  IndexSet<AgentIndex>& renewed = *coverage_.renewed();
  const Renewals renewals = renewed.size() > kManyRenewed ? Renewals::kMany : Renewals::kFew;
  if (renewals == Renewals::kMany) QueryFarKeysAnew();
  for (const AgentIndex agent : renewed) {
    if (context_.agents.Contains(agent) && coverage_[agent].renewed_from) Query(agent, renewals);
  }
  const Instant until = context_.clock.announce_until();
  const auto is_due = [until](Instant key) { return key <= until && !key.is_never(); };
  const EventQueue<AgentIndex>& due = coverage_.due();
  while (!due.empty() && is_due(due.top_key())) Query(due.top(), renewals);
  for (const AgentIndex agent : renewed) {
    if (renewals == Renewals::kMany && context_.agents.Contains(agent)) {
      coverage_[agent].renewed_cause = ClearanceCause::kNone;
    }
  }
  renewed.Clear();
  SettleQueried();
}

// Keys that were set in this step may be lowered by what is renewed from now on.
void ClearanceQueries::SettleQueried() {
  for (const AgentIndex agent : queried_) {
    if (!context_.agents.Contains(agent) || context_.agents[agent].expired) continue;
    if (coverage_.IsSaturated(agent) || coverage_[agent].renewed_from) continue;
    coverage_.Settle(agent);
  }
  queried_.clear();
}

void ClearanceQueries::Query(AgentIndex agent, Renewals renewals) {
  ++context_.counters->queries;
  coverage_[agent].queried_step = context_.clock.step;
  tracked_.Start(agent, pairs_.table(), context_.agents.index_end());
  if (NeedsTiersOnly(agent, renewals)) {
    QueryTiers(agent);
  } else {
    QueryAll(agent, renewals);
  }
}

// Whether the comparable partners are certified to be far beyond what is to be known now.
bool ClearanceQueries::NeedsTiersOnly(AgentIndex agent, Renewals renewals) const {
  const AgentCoverage& record = coverage_[agent];
  return !record.renewed_from && !coverage_.IsSaturated(agent) && renewals == Renewals::kFew &&
         pairs_.table().RoomFor(agent) > 0 && coverage_.tiers().HasGroupsBeside(agent) &&
         record.keys.comparable() > DueUntil(agent);
}

// The groups whose keys are not later are asked about.
Instant ClearanceQueries::DueUntil(AgentIndex agent) const {
  return std::max({context_.clock.announce_until(), coverage_[agent].keys.earliest(),
                   context_.agents[agent].stamp()});
}

// The agent stays settled: about agents that are renewed in this step, and comparable, it is not
// asked.
void ClearanceQueries::QueryTiers(AgentIndex agent) {
  AgentCoverage& record = coverage_[agent];
  groups_.clear();
  record.keys.TiersUpTo(DueUntil(agent), &groups_);
  for (const int group : groups_) {
    NextMeeting next;
    if (!TracksAll(agent, group)) {
      const Instant covered = record.keys.Of(group);
      next = QueryGroup({.agent = agent,
                         .group = group,
                         .from = std::min(context_.clock.now, covered),
                         .covered = covered,
                         .tracked = &tracked_});
    }
    if (coverage_.IsSaturated(agent)) return;
    record.keys.SetTier(group, next.when);
    if (!next.when.is_never() && next.when <= record.keys.earliest()) {
      record.next_partner = next.partner;
    }
  }
  coverage_.KeysChanged(agent);
}

void ClearanceQueries::QueryAll(AgentIndex agent, Renewals renewals) {
  AgentCoverage& record = coverage_[agent];
  const bool many = renewals == Renewals::kMany;
  const bool renewed = record.renewed_from.has_value();
  const bool was_saturated = coverage_.IsSaturated(agent);
  const ClearanceKeys before = record.keys;
  const Instant now = context_.clock.now;
  const Instant covered = std::min(was_saturated ? now : before.earliest(),
                                   record.renewed_from.value_or(Instant::Never()));
  const Promised promised{before, covered, renewed, was_saturated};
  record.renewed_from.reset();
  if (was_saturated) coverage_.EndSaturation(agent);
  coverage_.LeaveSettled(agent);
  queried_.push_back(agent);
  coverage_.voided()->Insert(agent);
  // Asked before its key was due, because many others changed: an earlier key stays.
  const bool early =
      many && !renewed && !was_saturated && covered > context_.clock.announce_until();
  const AgentIndex next_before = record.next_partner;
  const NextMeeting next = QueryGroups(agent, promised);
  if (!coverage_.IsSaturated(agent)) {
    if (!next.when.is_never()) record.next_partner = next.partner;
    if (early && next.when > covered) {
      record.next_partner = next_before;
      // No agent is in this tier: the earliest key alone is lowered.
      record.keys.SetTier(AccelerationTiers::kAbsent, covered);
    }
    coverage_.KeysChanged(agent);
  }
  const Instant from = std::min(now, covered);
  if (renewed) lowering_.Lower(agent, from, tracked_);
  if (many) return NotifyIfLowered(agent, covered);
  record.renewed_cause = ClearanceCause::kNone;
}

ClearanceQuestion ClearanceQueries::QuestionAbout(AgentIndex agent, int group,
                                                  const Promised& promised) {
  const bool own_key = !promised.renewed && !promised.was_saturated && group != kEveryGroup;
  const Instant covered = own_key ? promised.keys.Of(group) : promised.covered;
  return {.agent = agent,
          .group = group,
          .from = std::min(context_.clock.now, covered),
          .covered = covered,
          .renewed = promised.renewed,
          .was_saturated = promised.was_saturated,
          .tracked = &tracked_};
}

// Sets the keys of all groups beside the agent, unless it becomes saturated. Returns the earliest
// meeting of all.
NextMeeting ClearanceQueries::QueryGroups(AgentIndex agent, const Promised& promised) {
  AgentCoverage& record = coverage_[agent];
  groups_.clear();
  coverage_.tiers().GroupsBeside(agent, &groups_);
  const int comparable = groups_.empty() ? kEveryGroup : AccelerationTiers::kComparable;
  NextMeeting next = QueryGroup(QuestionAbout(agent, comparable, promised));
  if (!coverage_.IsSaturated(agent)) record.keys.SetAll(next.when);
  for (const int group : groups_) {
    if (coverage_.IsSaturated(agent) || TracksAll(agent, group)) continue;
    const NextMeeting first = QueryGroup(QuestionAbout(agent, group, promised));
    if (coverage_.IsSaturated(agent)) continue;
    record.keys.SetTier(group, first.when);
    if (first.when < next.when) next = first;
  }
  return next;
}

// Tracks the partners of one group that may be met soon. Returns the first of the others, unless
// the agent has become saturated.
NextMeeting ClearanceQueries::QueryGroup(const ClearanceQuestion& question) {
  TrackUncovered(question);
  if (IsCrowded(question)) {
    in_crowd_ = true;
    return {};
  }
  return QueryBroadPhase(question);
}

// None of the group is left that could be met.
bool ClearanceQueries::TracksAll(AgentIndex agent, int group) const {
  std::uint32_t tracked = 0;
  for (const PairSlot slot : pairs_.table().Of(agent)) {
    const AgentIndex partner = pairs_.table()[slot].PartnerOf(agent);
    tracked += coverage_.tiers().GroupOf(partner, agent) == group;
  }
  return tracked == coverage_.tiers().Count(group);
}

// An agent without room for another pair is saturated if there is a partner that should be tracked.
// In a crowd that usually is one that was in the way before, or that the last such agent met; so a
// crowd costs one pair query an agent, not one for each two.
bool ClearanceQueries::IsCrowded(const ClearanceQuestion& question) {
  const AgentTable& agents = context_.agents;
  const AgentIndex agent = question.agent;
  if (pairs_.table().RoomFor(agent) > 0) return false;
  const AgentRecord& record = agents[agent];
  const broad_phase::AgentBound bound = record.wide_bound();
  const AgentIndex before =
      question.was_saturated ? coverage_[agent].crowded_with : AgentIndex::None();
  for (const AgentIndex partner :
       {before, coverage_.last_saturated(), coverage_.last_untracked()}) {
    if (partner == agent || !agents.Contains(partner)) continue;
    const AgentRecord& other = agents[partner];
    if (other.expired || tracked_.Contains(partner)) continue;
    if (!CanMeet(record.declaration.filter, other.declaration.filter)) continue;
    ++context_.counters->pair_queries;
    const intersection::IntersectionTime time =
        EarliestIntersection(bound, other.wide_bound(), question.from);
    if (time.instant() > context_.clock.announce_until()) continue;
    coverage_.Saturate(agent, partner);
    return true;
  }
  return false;
}

NextMeeting ClearanceQueries::QueryBroadPhase(const ClearanceQuestion& question) {
  const AgentIndex agent = question.agent;
  // In a crowd most agents are saturated, and need no key.
  const bool crowd = in_crowd_ || question.was_saturated;
  const int begin = next_.Begin(question);
  const bool only_near = crowd || begin > kHorizonNear;
  const Instant until = only_near ? context_.clock.announce_until() : next_.horizons().At(begin);
  const AgentIndex no_room = due_.Find(question, until, &found_);
  if (!no_room.is_none()) coverage_.Saturate(agent, no_room);
  in_crowd_ = coverage_.IsSaturated(agent);
  TrackDue(question, found_);
  if (coverage_.IsSaturated(agent)) return {};
  const NextMeeting next = NextMeetingSearch::EarliestOf(found_, tracked_);
  if (next.when.is_never()) return next_.Find(question, until);
  next_.Record(question, next.when);
  return next;
}

void ClearanceQueries::TrackUncovered(const ClearanceQuestion& question) {
  for (const UncoveredPartner& partner : uncovered_.Find(question)) {
    TrackOrSaturate(question, partner, question.renewed ? Past::kUnknown : Past::kKnown);
  }
}

void ClearanceQueries::TrackDue(const ClearanceQuestion& question,
                                const std::vector<broad_phase::Neighbour>& found) {
  const AgentRecord& record = context_.agents[question.agent];
  const Instant until = context_.clock.announce_until();
  for (const broad_phase::Neighbour& meeting : found) {
    Instant when = meeting.time.instant();
    if (when > until) continue;
    const AgentIndex partner(meeting.partner);
    const bool overlap = meeting.time.seconds <= 0;
    // They may have met before: as far back as is not covered, and both were there.
    if (overlap && question.renewed) {
      when = std::min(when, UncoveredFrom(record, context_.agents[partner], question.covered));
    }
    const bool unknown_before =
        question.renewed || question.was_saturated || coverage_.IsSaturated(partner);
    TrackOrSaturate(question, {partner, when},
                    overlap && unknown_before ? Past::kUnknown : Past::kKnown);
    if (question.renewed) told_.NotifyPartner(partner, question.agent);
  }
}

void ClearanceQueries::TrackOrSaturate(const ClearanceQuestion& question,
                                       const UncoveredPartner& partner, Past past) {
  if (!pairs_.Track(question.agent, partner.partner, partner.free_until, past)) {
    coverage_.Saturate(question.agent, partner.partner);
    coverage_.Saturate(partner.partner, question.agent);
  }
  question.tracked->Add(partner.partner);
}

// They are asked about after the renewed agents, as if their keys were due. Which these are depends
// on keys alone, not on what the broad phase costs: answers may be early, and the more so the
// farther ahead they were asked for.
void ClearanceQueries::QueryFarKeysAnew() {
  far_.clear();
  coverage_.AppendSettledFrom(next_.horizons().At(kFarHorizon), &far_);
  for (const AgentIndex agent : far_) {
    coverage_.LeaveSettled(agent);
    coverage_.QueryAtOnce(agent);
  }
}

// An agent that was asked about, was not renewed itself, and relied on a later key up to now: one
// of the renewed agents is why.
void ClearanceQueries::NotifyIfLowered(AgentIndex agent, Instant before) {
  const AgentCoverage& record = coverage_[agent];
  if (record.renewed_cause != ClearanceCause::kNone || record.keys.earliest() >= before) return;
  const AgentIndex cause = coverage_.IsSaturated(agent) ? record.crowded_with : record.next_partner;
  if (coverage_[cause].renewed_cause != ClearanceCause::kNone) told_.NotifyPartner(agent, cause);
}

}  // namespace collision::detection
