#include "collision_core/broad_phase/query.h"

#include <algorithm>

#include "collision_core/motion/hypertrapezoid.h"

namespace collision {

PairTime MeetingTime(const BroadQuery& query, const SpaceTimeBound& a, const SpaceTimeBound& b) {
  if (query.bound == BoundKind::kHorn) {
    return EarliestIntersection(a, b, query.from, query.until);
  }
  const Instant expiry = std::min(a.state.expiry, b.state.expiry);
  if (!CanMeet(a.declaration, b.declaration) || (NeverMoves(a) && NeverMoves(b)) ||
      expiry <= query.from) {
    return {query.from, kInfinity};
  }
  PairTime time{query.from, FirstOverlap(MakeHypertrapezoid(a, query.from, query.until),
                                         MakeHypertrapezoid(b, query.from, query.until))};
  if (time.instant() >= expiry) time.seconds = kInfinity;
  return time;
}

}  // namespace collision
