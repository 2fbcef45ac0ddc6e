#include "collision_core/broad_phase/index/earliest_pair_sink.h"

#include <algorithm>

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::broad_phase {

EarliestPairSink::EarliestPairSink(const HornTable& table, const intersection::BroadQuery& query,
                                   BroadPhaseWork* work)
    : table_(table), query_(query), work_(work) {
  Limit(query.until);
}

// Rounded up; intersections are compared as instants, which are up to a nanosecond early.
void EarliestPairSink::Limit(Instant until) {
  limit_ =
      until.is_never() ? numeric::kInfinity
      : until <= query_.from
          ? numeric::kNanosecond
          : numeric::AddUp(numeric::SecondsBetween(query_.from, until).upper, numeric::kNanosecond);
}

bool MayMeet(const HornTable& table, std::uint32_t a, std::uint32_t b, const Within& within,
             BroadPhaseWork* work) {
  if (!table.CanMeetAtAll(a, b)) return false;
  ++work->filter_tests;
  const double bound = table.EarlierBound(a, b, within.from, within.seconds);
  // Infinite: the two never meet, whatever the limit is.
  const bool in_time = bound < numeric::kInfinity && kFilterEarliness * bound <= within.seconds;
  const bool may = in_time && !table.RuleOf(a, b).excluded;
  work->pair_queries += may;
  return may;
}

bool MayMeet(const Guest& guest, const HornTable& table, std::uint32_t agent, const Within& within,
             BroadPhaseWork* work) {
  const HornRow& row = table.row(agent);
  if (guest.row.still && row.still) return false;
  if (!table.FiltersLetMeet(agent, guest.filter)) return false;
  ++work->filter_tests;
  const double bound = HornTable::EarlierBound(guest.row, row, within.from, within.seconds);
  const bool may = bound < numeric::kInfinity && kFilterEarliness * bound <= within.seconds;
  work->pair_queries += may;
  return may;
}

bool MayMeet(const HornTable& table, const HalfSpaces::Entry& entry, std::uint32_t agent,
             const Within& within, BroadPhaseWork* work) {
  const HornRow& row = table.row(agent);
  const HalfSpace& half_space = entry.half_space;
  if (row.still || !table.FiltersLetMeet(agent, half_space.filter)) return false;
  ++work->filter_tests;
  const intersection::PairRule rule = table.RuleOf(agent, entry.agent);
  const bool may = !rule.excluded &&
                   (row.unfilterable || !HornTable::Near(within.from) ||
                    MayReach(entry, table.At(agent, within.from), rule.margin, within.seconds));
  work->pair_queries += may;
  return may;
}

intersection::IntersectionTime EarliestIntersectionOf(const intersection::BroadQuery& query,
                                                      const HornTable& table, std::uint32_t a,
                                                      std::uint32_t b) {
  if (!table.FiltersLetMeet(a, b)) return {query.from, numeric::kInfinity};
  const intersection::PairRule rule = table.RuleOf(a, b);
  CORE_CHECK(!rule.excluded, "an excluded pair has no time", a, b);
  return EarliestIntersectionOf(query, table.bound(a), table.bound(b), rule.margin);
}

intersection::IntersectionTime EarliestIntersectionOf(const intersection::BroadQuery& query,
                                                      const HalfSpaces::Entry& entry,
                                                      const HornTable& table, std::uint32_t agent) {
  const intersection::PairRule rule = table.RuleOf(agent, entry.agent);
  CORE_CHECK(!rule.excluded, "an excluded pair has no time", entry.agent, agent);
  return EarliestIntersectionOf(query, entry.half_space, table.agent_bound(agent), rule.margin);
}

bool EarliestPairSink::Betters(std::uint32_t lower, std::uint32_t higher) const {
  // No time is earlier than the query's begin: once the best is there, only lower indices count.
  if (!best_ || when_ > query_.from) return true;
  return lower != best_->lower ? lower < best_->lower : higher < best_->higher;
}

void EarliestPairSink::Offer(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t lower = std::min(a, b), higher = std::max(a, b);
  if (a == b || !Betters(lower, higher)) return;
  if (query_.bound == intersection::BoundKind::kHypertrapezoid) {
    if (table_.RuleOf(lower, higher).excluded) return;
    ++work_->pair_queries;
  } else if (!MayMeet(table_, lower, higher, {query_.from, limit_}, work_)) {
    return;
  }
  Take({lower, higher, EarliestIntersectionOf(Narrowed(lower, higher), table_, lower, higher)});
}

// A pair that is later than the best, or as late and of higher indices, needs no exact answer. The
// window of a hypertrapezoid is part of the query and stays.
intersection::BroadQuery EarliestPairSink::Narrowed(std::uint32_t lower,
                                                    std::uint32_t higher) const {
  intersection::BroadQuery narrowed = query_;
  if (!best_ || query_.bound == intersection::BoundKind::kHypertrapezoid) return narrowed;
  const bool wins = lower != best_->lower ? lower < best_->lower : higher < best_->higher;
  narrowed.until = wins ? when_ : Instant::FromNanoseconds(when_.nanoseconds() - 1);
  return narrowed;
}

void EarliestPairSink::OfferHalfSpace(const HalfSpaces::Entry& entry, std::uint32_t agent) {
  const std::uint32_t lower = std::min(entry.agent, agent), higher = std::max(entry.agent, agent);
  if (!Betters(lower, higher)) return;
  if (!MayMeet(table_, entry, agent, {query_.from, limit_}, work_)) return;
  Take({lower, higher, EarliestIntersectionOf(query_, entry, table_, agent)});
}

void EarliestPairSink::Take(const intersection::IntersectingPair& pair) {
  if (pair.time.instant().is_never() || (best_ && !(pair < *best_))) return;
  best_ = pair;
  when_ = pair.time.instant();
  Limit(pair.time.instant());
}

}  // namespace collision::broad_phase
