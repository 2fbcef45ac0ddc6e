#include "collision_core/detection/clearance/clearance_queries.h"

#include <algorithm>

namespace collision::detection {
namespace {

/// If more agents than this are renewed in one step, agents with far keys are queried anew: to look
/// at each such key for each renewed agent would cost more.
constexpr std::size_t kManyRenewed = 4096;

/// Keys beyond this horizon are far.
constexpr int kFarHorizon = 4;

}  // namespace

ClearanceQueries::ClearanceQueries(const DetectorContext& context, const QueryTargets& targets,
                                   const ClearanceFilter& filter)
    : context_(context),
      coverage_(*targets.coverage),
      reported_(*targets.reported),
      pairs_(targets.pairs->table()),
      band_query_(context, targets),
      lowering_(context, targets, filter) {}

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

// From now on a renewed agent may lower the keys that were set in this step.
void ClearanceQueries::SettleQueried() {
  for (const AgentIndex agent : queried_) {
    if (!context_.agents.Contains(agent) || context_.agents[agent].expired) continue;
    if (coverage_.IsSaturated(agent) || coverage_[agent].renewed_from) continue;
    coverage_.MarkLowerable(agent);
  }
  queried_.clear();
}

void ClearanceQueries::Query(AgentIndex agent, Renewals renewals) {
  ++context_.counters->queries;
  coverage_[agent].queried_step = context_.clock.step;
  tracked_.Start(agent, pairs_, context_.agents.index_end());
  if (NeedsTiersOnly(agent, renewals)) {
    QueryTiers(agent);
  } else {
    QueryAll(agent, renewals);
  }
  context_.clock.MadeProgress();
}

// Whether the key of the comparable partners lies beyond everything that this step must know.
bool ClearanceQueries::NeedsTiersOnly(AgentIndex agent, Renewals renewals) const {
  const AgentCoverage& record = coverage_[agent];
  return !record.renewed_from && !coverage_.IsSaturated(agent) && renewals == Renewals::kFew &&
         pairs_.RoomFor(agent) > 0 && coverage_.tiers().HasOwnBands(agent) &&
         record.keys.comparable() > DueUntil(agent);
}

// A query covers the bands whose keys are not later than this.
Instant ClearanceQueries::DueUntil(AgentIndex agent) const {
  return std::max({context_.clock.announce_until(), coverage_[agent].keys.earliest(),
                   context_.agents[agent].stamp()});
}

// The agent stays settled: the query leaves out comparable agents that are renewed in this step.
void ClearanceQueries::QueryTiers(AgentIndex agent) {
  AgentCoverage& record = coverage_[agent];
  bands_.clear();
  record.keys.TiersUpTo(DueUntil(agent), &bands_);
  for (const int band : bands_) {
    NextNeighbour next;
    if (!band_query_.TracksAll(agent, band)) {
      const Instant covered = record.keys.Of(band);
      next = band_query_.Find({.agent = agent,
                               .band = band,
                               .from = std::min(context_.clock.now, covered),
                               .covered = covered,
                               .tracked = &tracked_});
    }
    if (coverage_.IsSaturated(agent)) return;
    record.keys.SetTier(band, next.when);
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
  coverage_.UnmarkLowerable(agent);
  queried_.push_back(agent);
  coverage_.voided()->Insert(agent);
  // Queried before its key was due, because many others changed: an earlier key stays.
  const bool early =
      many && !renewed && !was_saturated && covered > context_.clock.announce_until();
  const AgentIndex next_before = record.next_partner;
  const NextNeighbour next = QueryBands(agent, promised);
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

ClearanceQuery ClearanceQueries::QueryFor(AgentIndex agent, int band, const Promised& promised) {
  const bool own_key = !promised.renewed && !promised.was_saturated && band != kEveryBand;
  const Instant covered = own_key ? promised.keys.Of(band) : promised.covered;
  return {.agent = agent,
          .band = band,
          .from = std::min(context_.clock.now, covered),
          .covered = covered,
          .renewed = promised.renewed,
          .was_saturated = promised.was_saturated,
          .tracked = &tracked_};
}

// Sets the keys of all bands beside the agent, unless it becomes saturated. Returns the earliest
// intersection of all.
NextNeighbour ClearanceQueries::QueryBands(AgentIndex agent, const Promised& promised) {
  AgentCoverage& record = coverage_[agent];
  bands_.clear();
  coverage_.tiers().OwnBandsOf(agent, &bands_);
  const int comparable = bands_.empty() ? kEveryBand : AccelerationTiers::kComparable;
  NextNeighbour next = band_query_.Find(QueryFor(agent, comparable, promised));
  if (!coverage_.IsSaturated(agent)) record.keys.SetAll(next.when);
  for (const int band : bands_) {
    if (coverage_.IsSaturated(agent) || band_query_.TracksAll(agent, band)) continue;
    const NextNeighbour first = band_query_.Find(QueryFor(agent, band, promised));
    if (coverage_.IsSaturated(agent)) continue;
    record.keys.SetTier(band, first.when);
    if (first.when < next.when) next = first;
  }
  return next;
}

// Queries agents with far keys after the renewed ones, as if their keys were due. The choice
// depends on keys alone, not on the cost of the broad phase: an answer may be early, and the more
// so the farther ahead it lies.
void ClearanceQueries::QueryFarKeysAnew() {
  far_.clear();
  coverage_.AppendLowerableFrom(band_query_.horizons().At(kFarHorizon), &far_);
  for (const AgentIndex agent : far_) {
    coverage_.UnmarkLowerable(agent);
    coverage_.QueryAtOnce(agent);
  }
}

// The key of an agent that was queried but not renewed is now earlier: a renewed agent is the
// cause.
void ClearanceQueries::NotifyIfLowered(AgentIndex agent, Instant before) {
  const AgentCoverage& record = coverage_[agent];
  if (record.renewed_cause != ClearanceCause::kNone || record.keys.earliest() >= before) return;
  const AgentIndex cause = coverage_.IsSaturated(agent) ? record.crowded_with : record.next_partner;
  if (coverage_[cause].renewed_cause != ClearanceCause::kNone)
    reported_.NotifyPartner(agent, cause);
}

}  // namespace collision::detection
