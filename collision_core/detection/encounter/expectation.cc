#include "collision_core/detection/encounter/expectation.h"

#include <algorithm>

#include "collision_core/narrow_phase/approach/closest_approach.h"
#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// How narrow the begin of an expected contact is asked for [s]: far narrower than anybody keeps a
// motion.
constexpr double kTolerance = 1e-6;

// For the time of contact; the rest for how near they pass.
constexpr double kContactShare = 0.7;

// The motion that a state tells, kept for ever: no errors, no deviation, no skew.
narrow_phase::KnownMotion Kept(const History::Sample& sample) {
  motion::SpaceTimeBound kept = sample.bound;
  kept.state.position_error = kept.state.velocity_error = kept.state.rotation_error = 0;
  kept.state.direction.setZero();
  kept.limits.acceleration_max = kept.limits.jerk_max = kept.limits.time_step = 0;
  kept.limits.speed_max = numeric::kInfinity;
  kept.limits.angular_acceleration_max = 0;
  kept.skew = 0;
  return {.last = kept, .next = std::nullopt, .shape = sample.shape};
}

}  // namespace

std::optional<Expectation> ExpectationOf(const History& a, const History& b, Instant from,
                                         double ahead, WorkBudget* work) {
  const History::Sample &of_a = a.newest(), &of_b = b.newest();
  if (of_a.shape_awaited || of_b.shape_awaited) return std::nullopt;
  from = std::max({from, of_a.bound.state.stamp, of_b.bound.state.stamp});
  const Instant until = std::min(
      {numeric::AddRoundedDown(from, ahead), of_a.bound.state.expiry, of_b.bound.state.expiry});
  if (until <= from) return std::nullopt;
  narrow_phase::BodyPair bodies = SegmentsOf(Kept(of_a), Kept(of_b), from);
  bodies.a.half_space = of_a.half_space;
  bodies.b.half_space = of_b.half_space;
  const double duration = numeric::SecondsBetween(from, until).upper;
  ReplaceHalfSpace(duration, &bodies);
  if (bodies.a.awaited || bodies.b.awaited) return std::nullopt;  // no block is large enough
  const auto bracket = [from](const numeric::Interval& seconds) {
    return TimeBracket{numeric::AddRoundedDown(from, seconds.lower),
                       numeric::AddRoundedUp(from, seconds.upper)};
  };
  Expectation expected;
  expected.until = until;
  narrow_phase::TimeOfContactResult contact;
  {
    const WorkShare share(kContactShare, work);
    contact = TimeOfContact(bodies.a, bodies.b, duration, {kTolerance, 0}, work);
  }
  if (contact.status == narrow_phase::ContactStatus::kContact) {
    expected.outcome = ExpectedOutcome::kTouch;
    expected.begin = bracket(contact.begin);
  }
  if (contact.status == narrow_phase::ContactStatus::kFree) {
    expected.outcome = ExpectedOutcome::kPass;
    const narrow_phase::ClosestApproach closest =
        FindClosestApproach(bodies.a, bodies.b, {.duration = duration}, work);
    // Free throughout: no distance is less than 0, whatever the budget left.
    expected.closest = {from,
                        until,
                        bracket(closest.at),
                        {std::max(0.0, closest.distance.lower), closest.distance.upper}};
    expected.closest->at.latest = std::min(expected.closest->at.latest, until);
  }
  return expected;
}

}  // namespace collision::detection
