#include "collision_core/detection/pairs/interval_evaluation.h"

#include <algorithm>

#include "collision_core/detection/encounter/proximity_at.h"
#include "collision_core/narrow_phase/contact/ball_proximity.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// The instant at which two balls are certified nearest, of both ends and of the one at which the
// centres' lines are nearest.
NearestInstant NearestOf(const narrow_phase::BallSegment& a, const narrow_phase::BallSegment& b,
                         Instant from, double duration) {
  NearestInstant nearest;
  if (a.bounds.empty() || b.bounds.empty()) return nearest;
  const Eigen::Vector3d d = (b.bounds[0].centre() - a.bounds[0].centre()).middle();
  const Eigen::Vector3d w =
      (b.bounds[0].VelocityAt(0.5 * duration) - a.bounds[0].VelocityAt(0.5 * duration)).middle();
  const double speed_squared = w.squaredNorm();
  const double bottom = speed_squared > 0 ? -d.dot(w) / speed_squared : 0;
  for (const double delta : {0.0, std::clamp(bottom, 0.0, duration), duration}) {
    const narrow_phase::Proximity found = BallProximity(a, b, delta);
    if (nearest.at.is_never() || found.separation.upper < nearest.found.separation.upper) {
      nearest = {numeric::AddRoundedDown(from, delta), found};
    }
  }
  return nearest;
}

// If two shapes may touch as soon as the segment begins, the normal is that at the last state
// before, where the pose is known best. There is none if a jump lies in between or a shape was not
// known.
narrow_phase::ContactNormal NormalBefore(const History& a, const History& b, Instant from,
                                         WorkBudget* work) {
  const Instant of_a = a.LastStampBefore(from), of_b = b.LastStampBefore(from);
  if (of_a.is_never() || of_b.is_never()) return {};
  const Instant before = std::max(of_a, of_b);
  const Instant to = std::min({from, a.NextCutAfter(before), b.NextCutAfter(before)});
  const auto [body_a, body_b] = BothOver(a, b, before, to);
  if (body_a.awaited || body_b.awaited || (body_a.is_ball() && body_b.is_ball())) return {};
  return NormalAt(body_a, body_b, 0, work);
}

// Evaluates [tracker->at(), to]. True if QuickBallContact() decided the segment.
bool EvaluateOne(const History& history_a, const History& history_b, Instant to, WorkBudget* work,
                 ContactTracker* tracker) {
  const Instant from = tracker->at();
  const auto [a, b] = BothOver(history_a, history_b, from, to);
  const double duration = numeric::SecondsBetween(from, to).upper;
  const bool balls = a.is_ball() && b.is_ball();
  const bool bounded = work->when_exhausted() == WhenExhausted::kLeaveUndecided;
  work->Spend(bounded && !balls ? kSegmentUnits : 1);
  if (balls) {
    if (const auto contact = QuickBallContact(a.ball, b.ball, duration)) {
      tracker->Apply(*contact, to, {}, {});
      return true;
    }
  }
  narrow_phase::SegmentResult times = EvaluateBallSegment(a.ball, b.ball, duration);
  NearestInstant nearest;
  narrow_phase::ContactNormal normal;
  if (times.free_until < duration) {
    if (a.awaited || b.awaited) {
      times.contact_from = 1, times.contact_to = 0;
      nearest = NearestOf(a.ball, b.ball, from, duration);
      nearest.found = ProximityOfAwaited(nearest.found);
    } else if (balls) {
      // For a contact, report its begin, not the closest approach.
      const bool goes_on = tracker->in_contact() && times.free_until <= 0;
      const bool contact = goes_on || times.contact_from <= times.contact_to;
      if (!contact) nearest = NearestOf(a.ball, b.ball, from, duration);
    } else {
      const narrow_phase::ShapeSegmentResult result =
          EvaluateShapeSegment(a, b, duration, times, work);
      times = result.times;
      normal = result.normal;
      if (tracker->free() && times.free_until < duration && !normal.is_good()) {
        const narrow_phase::ContactNormal before = NormalBefore(history_a, history_b, from, work);
        if (before.known && (!normal.known || before.error < normal.error)) normal = before;
      }
      if (result.examined) {
        nearest = {std::min(numeric::AddRoundedDown(from, result.nearest_at), to), result.nearest,
                   result.exhausted};
      }
    }
  }
  tracker->Apply(times, to, nearest, normal);
  return false;
}

// The budget is used up: neither freedom nor contact is known from here to `until`.
void LeaveUndecided(Instant until, ContactTracker* tracker) {
  const double duration = numeric::SecondsBetween(tracker->at(), until).upper;
  NearestInstant none;
  none.exhausted = true;
  tracker->Apply({.free_until = 0, .free_from = duration}, until, none, {});
}

}  // namespace

SegmentCount EvaluateSegments(const History& a, const History& b, Instant until, WorkBudget* work,
                              ContactTracker* tracker) {
  SegmentCount count;
  while (tracker->at() < until) {
    if (work->exhausted() && work->when_exhausted() == WhenExhausted::kLeaveUndecided) {
      LeaveUndecided(until, tracker);
      break;
    }
    const Instant from = tracker->at();
    const Instant to = std::min({until, a.NextCutAfter(from), b.NextCutAfter(from)});
    count.quick += EvaluateOne(a, b, to, work, tracker);
    ++count.segments;
  }
  return count;
}

bool HaveKnownShapes(const History& a, const History& b) {
  const auto is_known = [](const History::Sample& newest) {
    return newest.shape || newest.half_space;
  };
  return is_known(a.newest()) || is_known(b.newest());
}

Instant ShapesFreeAhead(const History& a, const History& b, Instant from, Instant until,
                        WorkBudget* work) {
  CORE_CHECK(from >= a.newest().bound.state.stamp && from >= b.newest().bound.state.stamp,
             "the newest bounds hold from their states on", from.nanoseconds());
  until = std::min({until, a.NextCutAfter(from), b.NextCutAfter(from)});
  if (until <= from) return from;
  const auto [of_a, of_b] = BothOver(a, b, from, until);
  if (of_a.awaited || of_b.awaited || (of_a.is_ball() && of_b.is_ball())) return from;
  const double duration = numeric::SecondsBetween(from, until).upper;
  const double free = FreeAhead(of_a, of_b, 0, duration, work);
  return std::min(until, numeric::AddRoundedDown(from, free));
}

}  // namespace collision::detection
