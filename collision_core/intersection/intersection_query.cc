#include "collision_core/intersection/intersection_query.h"

#include <algorithm>

#include "collision_core/intersection/pair_rules.h"
#include "collision_core/motion/hypertrapezoid.h"

namespace collision::intersection {
namespace {

/// Rounded outward; both alike, so that it does not matter which one comes first.
motion::Hypertrapezoid Grown(motion::Hypertrapezoid h, double half_margin) {
  for (int axis = 0; axis < 3; ++axis) {
    for (double* lower : {&h.lower_start[axis], &h.lower_end[axis]}) {
      *lower = numeric::AddDown(*lower, -half_margin);
    }
    for (double* upper : {&h.upper_start[axis], &h.upper_end[axis]}) {
      *upper = numeric::AddUp(*upper, half_margin);
    }
  }
  return h;
}

}  // namespace

IntersectionTime EarliestIntersectionOf(const BroadQuery& query, const motion::SpaceTimeBound& a,
                                        const motion::SpaceTimeBound& b, double margin) {
  if (query.bound == BoundKind::kHorn) {
    return EarliestIntersection(a, b, query.from, query.until, margin);
  }
  const Instant expiry = std::min(a.state.expiry, b.state.expiry);
  if ((NeverMoves(a) && NeverMoves(b)) || expiry <= query.from) {
    return {query.from, numeric::kInfinity};
  }
  motion::Hypertrapezoid of_A = MakeHypertrapezoid(a, query.from, query.until);
  motion::Hypertrapezoid of_B = MakeHypertrapezoid(b, query.from, query.until);
  if (margin > 0) {
    of_A = Grown(of_A, HalfUp(margin));
    of_B = Grown(of_B, HalfUp(margin));
  }
  IntersectionTime time{query.from, FirstOverlap(of_A, of_B)};
  if (time.instant() >= expiry) time.seconds = numeric::kInfinity;
  return time;
}

}  // namespace collision::intersection
