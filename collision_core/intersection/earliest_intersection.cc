#include "collision_core/intersection/earliest_intersection.h"

#include <algorithm>

#include "collision_core/base/check.h"
#include "collision_core/intersection/box_overlap.h"
#include "collision_core/intersection/capped_balls.h"
#include "collision_core/intersection/overlap_estimate.h"
#include "collision_core/intersection/quick_horn_pair.h"
#include "collision_core/numeric/first_approach.h"
#include "collision_core/numeric/seconds.h"

namespace collision::intersection {
namespace {

/// Beyond `until`, an intersection within whose nanosecond rounds down to it, the search goes on
/// for this long: that nanosecond, and another for the rounding of seconds [s].
constexpr double kBeyondUntil = 2 * numeric::kNanosecond;

/// The first overlap of the two horns' balls: decided in plain doubles, or with intervals from
/// where they gave up.
double BallTime(const BoundPair& pair, double limit) {
  const numeric::QuickAnswer quick = QuickFirstApproach(QuickHornPair(pair), limit);
  if (quick.decided) return quick.delta;
  return FirstApproach(
      Difference(ForwardBall(pair.a, pair.base), ForwardBall(pair.b, pair.base), pair.margin),
      limit, quick.delta);
}

}  // namespace

IntersectionTime EarliestIntersection(const motion::SpaceTimeBound& a,
                                      const motion::SpaceTimeBound& b, Instant from) {
  return EarliestIntersection(a, b, from, Instant::Never());
}

IntersectionTime EarliestIntersection(const motion::SpaceTimeBound& a,
                                      const motion::SpaceTimeBound& b, Instant from, Instant until,
                                      double margin) {
  CORE_CHECK(margin >= 0 && margin < numeric::kInfinity, "a margin is finite and not below 0",
             margin);
  const Instant base = std::max({from, a.state.stamp, b.state.stamp});
  const Instant expiry = std::min(a.state.expiry, b.state.expiry);
  const IntersectionTime never{base, numeric::kInfinity};
  if (expiry <= base || base > until) return never;
  if (NeverMoves(a) && NeverMoves(b)) return never;
  const Instant end =
      until.is_never() ? expiry : std::min(expiry, numeric::AddRoundedUp(until, kBeyondUntil));
  const double limit =
      end.is_never() ? numeric::kInfinity : numeric::SecondsBetween(base, end).upper;
  const BoundPair pair{a, b, base, margin};
  IntersectionTime time{base, BallTime(pair, limit)};
  // The horns' balls alone decide unless a direction or a cap is declared.
  if (time.seconds < limit && BoxesMatter(pair)) {
    const auto stands = [&] { return SeemToOverlap(pair, time.seconds); };
    if (!stands()) {
      time.seconds = LaterOfCappedBalls(pair, time.seconds, limit);
      if (time.seconds < limit && !stands()) {
        time.seconds = LaterOfBoxes(pair, time.seconds, limit);
      }
    }
  }
  return time.seconds < limit && time.instant() <= until ? time : never;
}

}  // namespace collision::intersection
