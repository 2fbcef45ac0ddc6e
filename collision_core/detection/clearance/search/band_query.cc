#include "collision_core/detection/clearance/search/band_query.h"

#include <algorithm>

namespace collision::detection {
namespace {

/// A query that begins beyond this horizon looks for the next intersection separately.
constexpr int kHorizonNear = 4;

}  // namespace

BandQuery::BandQuery(const DetectorContext& context, const QueryTargets& targets)
    : context_(context),
      queries_(context),
      coverage_(*targets.coverage),
      reported_(*targets.reported),
      pairs_(*targets.pairs),
      uncovered_(context, coverage_, targets.broad_phase, targets.former),
      due_(targets.broad_phase, coverage_.tiers(), pairs_.table(), context.clock),
      next_(targets.broad_phase, coverage_.tiers(), context.clock) {}

NextNeighbour BandQuery::Find(const ClearanceQuery& query) {
  TrackUncovered(query);
  if (IsCrowded(query)) {
    in_crowd_ = true;
    return {};
  }
  return QueryBroadPhase(query);
}

bool BandQuery::TracksAll(AgentIndex agent, int band) const {
  std::uint32_t tracked = 0;
  for (const PairSlot slot : pairs_.table().Of(agent)) {
    const AgentIndex partner = pairs_.table()[slot].PartnerOf(agent);
    tracked += coverage_.tiers().BandOf(partner, agent) == band;
  }
  return tracked == coverage_.tiers().Count(band);
}

void BandQuery::TrackUncovered(const ClearanceQuery& query) {
  for (const UncoveredPartner& partner : uncovered_.Find(query)) {
    TrackOrSaturate(query, partner, query.renewed ? Past::kUnknown : Past::kKnown);
  }
}

// An agent without room for another pair is saturated if there is a partner that should be tracked.
// In a crowd that usually is the partner that saturated it before, or the one that saturated the
// last such agent; so a crowd costs one pair query an agent, not one a pair.
bool BandQuery::IsCrowded(const ClearanceQuery& query) {
  const AgentTable& agents = context_.agents;
  const AgentIndex agent = query.agent;
  if (pairs_.table().RoomFor(agent) > 0) return false;
  const AgentIndex before =
      query.was_saturated ? coverage_[agent].crowded_with : AgentIndex::None();
  for (const AgentIndex partner :
       {before, coverage_.last_saturated(), coverage_.last_untracked()}) {
    if (partner == agent || !agents.Contains(partner)) continue;
    if (agents[partner].expired || query.tracked->Contains(partner)) continue;
    if (!queries_.MayMeet(agent, partner)) continue;
    const Instant when = queries_.EarliestOfWide(agent, partner, query.from);
    if (when > context_.clock.announce_until()) continue;
    coverage_.Saturate(agent, partner);
    return true;
  }
  return false;
}

NextNeighbour BandQuery::QueryBroadPhase(const ClearanceQuery& query) {
  const AgentIndex agent = query.agent;
  // In a crowd most agents are saturated, and need no key.
  const bool crowd = in_crowd_ || query.was_saturated;
  const int begin = next_.Begin(query);
  const bool only_near = crowd || begin > kHorizonNear;
  const Instant until = only_near ? context_.clock.announce_until() : next_.horizons().At(begin);
  const AgentIndex no_room = due_.Find(query, until, &found_);
  if (!no_room.is_none()) coverage_.Saturate(agent, no_room);
  in_crowd_ = coverage_.IsSaturated(agent);
  TrackDue(query);
  if (coverage_.IsSaturated(agent)) return {};
  const NextNeighbour next = NextNeighbourSearch::EarliestOf(found_, *query.tracked);
  if (next.when.is_never()) return next_.Find(query, until);
  next_.Record(query, next.when);
  return next;
}

void BandQuery::TrackDue(const ClearanceQuery& query) {
  const AgentRecord& record = context_.agents[query.agent];
  const Instant until = context_.clock.announce_until();
  for (const broad_phase::Neighbour& neighbour : found_) {
    Instant when = neighbour.time.instant();
    if (when > until) continue;
    const AgentIndex partner(neighbour.partner);
    const bool overlap = neighbour.time.seconds <= 0;
    // They may have met before, at any time that is not covered and at which both were there.
    if (overlap && query.renewed) {
      when = std::min(when, UncoveredFrom(record, context_.agents[partner], query.covered));
    }
    const bool unknown_before =
        query.renewed || query.was_saturated || coverage_.IsSaturated(partner);
    TrackOrSaturate(query, {partner, when},
                    overlap && unknown_before ? Past::kUnknown : Past::kKnown);
    if (query.renewed) reported_.NotifyPartner(partner, query.agent);
  }
}

// Before both were there nothing is known: an agent may be admitted with a state ahead of now, and
// its key come due with the intersection at that very state.
void BandQuery::TrackOrSaturate(const ClearanceQuery& query, const UncoveredPartner& partner,
                                Past past) {
  const Instant both = UncoveredFrom(context_.agents[query.agent], context_.agents[partner.partner],
                                     Instant::Always());
  Instant free_until = partner.free_until;
  // The partner may be renewed from an earlier time on; its own query leaves out tracked pairs.
  const std::optional<Instant> renewed = coverage_[partner.partner].renewed_from;
  if (renewed && *renewed < query.covered) {
    free_until = std::min(free_until, std::max(*renewed, both));
    past = Past::kUnknown;
  }
  if (free_until <= both) past = Past::kUnknown;
  if (!pairs_.Track(query.agent, partner.partner, free_until, past)) {
    coverage_.Saturate(query.agent, partner.partner);
    coverage_.Saturate(partner.partner, query.agent);
  }
  query.tracked->Add(partner.partner);
}

}  // namespace collision::detection
