#include "collision_core/detection/encounter/closest_so_far.h"

#include <algorithm>

#include "collision_core/narrow_phase/approach/closest_approach.h"
#include "collision_core/narrow_phase/contact/ball_contact.h"
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

// How far two balls are apart at the end of a segment, from above. The distance of shapes takes a
// search.
double UpperAtEnd(const narrow_phase::BodyPair& pair, Instant from, Instant to) {
  const auto& [a, b] = pair;
  if (a.ball.bounds.empty() || b.ball.bounds.empty()) return numeric::kInfinity;
  if (!a.is_ball() || !b.is_ball()) return numeric::kInfinity;
  return EvaluateBallsAt(a.ball, b.ball, numeric::SecondsBetween(from, to).upper).separation.upper;
}

}  // namespace

std::uint64_t FollowClosest(const History& a, const History& b, const FollowLimits& limits,
                            PublishedEvent* published) {
  std::optional<ClosestApproach>& closest = published->closest;
  Instant& at = published->followed_until;
  const bool touching = published->event.status == EventStatus::kConfirmed;
  const auto end_of_segment = [&](Instant from) {
    return std::min({limits.until, a.NextCutAfter(from), b.NextCutAfter(from)});
  };
  Instant last = at;
  while (end_of_segment(last) < limits.until) last = end_of_segment(last);
  const Instant end = limits.approaching ? last : limits.until;
  if (at >= end) return 0;
  // They have come this near in the end; what is farther before is not worth a search.
  const double in_the_end = UpperAtEnd(BothOver(a, b, last, limits.until), last, limits.until);
  WorkBudget work_on_shapes(limits.shape_units);
  std::uint64_t units = 0;
  while (at < end) {
    const Instant from = at;
    at = end_of_segment(from);
    const auto [of_a, of_b] = BothOver(a, b, from, at);
    const bool balls = of_a.is_ball() && of_b.is_ball();
    if (touching && !balls) continue;
    if (of_a.ball.bounds.empty() || of_b.ball.bounds.empty()) {
      closest.reset();
      continue;
    }
    WorkBudget work_on_balls(touching ? kTouchingUnits : kPassingUnits);
    const double beyond = std::min(in_the_end, closest ? closest->distance.upper : in_the_end);
    const narrow_phase::ClosestApproach found = FindClosestApproach(
        of_a, of_b,
        {.duration = numeric::SecondsBetween(from, at).upper, .beyond = beyond, .continued = true},
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
