#include "collision_core/broad_phase/best_meeting.h"

#include <algorithm>

namespace collision {

BestMeeting::BestMeeting(const HornTable& table, const BroadQuery& query, BroadPhaseWork* work)
    : table_(table), query_(query), work_(work) {
  Limit(query.until);
}

// Rounded up; meetings are compared as instants, which are up to a nanosecond early.
void BestMeeting::Limit(Instant until) {
  constexpr double kNanosecond = 1e-9;
  limit_ = until.is_never()       ? kInfinity
           : until <= query_.from ? kNanosecond
                                  : AddUp(SecondsBetween(query_.from, until).upper, kNanosecond);
}

bool MayMeet(const HornTable& table, std::uint32_t a, std::uint32_t b, Instant from, double limit,
             BroadPhaseWork* work) {
  if (!CanMeet(table.row(a), table.row(b))) return false;
  ++work->filter_tests;
  // The canonical answer itself may be early, by a relative 1e-9.
  constexpr double kEarly = 1 - 4e-9;
  const bool may = kEarly * table.EarlierBound(a, b, from, limit) <= limit;
  work->pair_queries += may;
  return may;
}

bool BestMeeting::Betters(std::uint32_t lower, std::uint32_t higher) const {
  // Nothing comes before the query's begin, so that of those only the lowest indices count.
  if (!best_ || when_ > query_.from) return true;
  return lower != best_->lower ? lower < best_->lower : higher < best_->higher;
}

void BestMeeting::Offer(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t lower = std::min(a, b), higher = std::max(a, b);
  if (a == b || !Betters(lower, higher)) return;
  if (query_.bound == BoundKind::kHypertrapezoid) {
    ++work_->pair_queries;
  } else if (!MayMeet(table_, lower, higher, query_.from, limit_, work_)) {
    return;
  }
  const PairMeeting meeting{lower, higher,
                            MeetingTime(query_, table_.bound(lower), table_.bound(higher))};
  if (meeting.time.instant().is_never() || (best_ && !(meeting < *best_))) return;
  best_ = meeting;
  when_ = meeting.time.instant();
  Limit(meeting.time.instant());
}

}  // namespace collision
