#include "collision_core/detection/encounter/closest_so_far.h"

#include <algorithm>

#include "collision_core/narrow_phase/approach/closest_approach.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// Two balls over one segment: enough for the last digits of a passage; in contact, where segment
// follows on segment, enough for both ends and the middle.
constexpr std::uint64_t kPassingUnits = 400;
constexpr std::uint64_t kTouchingUnits = 2;

// The nearest of two successive spans of time.
ClosestApproach Nearest(const ClosestApproach& before, const ClosestApproach& after) {
  ClosestApproach both = before;
  both.until = after.until;
  if (after.distance.lower > before.distance.upper) return both;
  if (before.distance.lower > after.distance.upper) {
    both.at = after.at;
    both.distance = after.distance;
    return both;
  }
  both.at = {std::min(before.at.earliest, after.at.earliest),
             std::max(before.at.latest, after.at.latest)};
  both.distance = {std::min(before.distance.lower, after.distance.lower),
                   std::min(before.distance.upper, after.distance.upper)};
  return both;
}

}  // namespace

std::uint64_t FollowClosest(const History& a, const History& b, Instant until,
                            std::uint64_t allowed, PublishedEvent* published) {
  std::optional<ClosestApproach>& closest = published->closest;
  Instant& at = published->followed_until;
  const bool touching = published->event.status == EventStatus::kConfirmed;
  WorkBudget work_on_shapes(allowed);
  std::uint64_t units = 0;
  while (at < until) {
    const Instant from = at;
    at = std::min({until, a.NextCutAfter(from), b.NextCutAfter(from)});
    const auto [of_a, of_b] = BothOver(a, b, from, at);
    const bool balls = of_a.is_ball() && of_b.is_ball();
    if (touching && !balls) continue;
    if (of_a.ball.bounds.empty() || of_b.ball.bounds.empty()) {
      closest.reset();
      continue;
    }
    WorkBudget work_on_balls(touching ? kTouchingUnits : kPassingUnits);
    const narrow_phase::ClosestApproach found =
        FindClosestApproach(of_a, of_b, numeric::SecondsBetween(from, at).upper,
                            closest ? closest->distance.upper : numeric::kInfinity,
                            balls ? &work_on_balls : &work_on_shapes);
    units += work_on_balls.spent();
    const ClosestApproach here{from,
                               at,
                               {numeric::AddRoundedDown(from, found.at.lower),
                                std::min(at, numeric::AddRoundedUp(from, found.at.upper))},
                               found.distance};
    closest = closest ? Nearest(*closest, here) : here;
  }
  return units + work_on_shapes.spent();
}

}  // namespace collision::detection
