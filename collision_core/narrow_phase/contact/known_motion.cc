// Segments of two bodies from their states, in a frame that moves along with one of them.
#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "collision_core/numeric/seconds.h"

namespace collision::narrow_phase {
namespace {

// With R the state of the frame, X another one, s their stamps: seen from the frame the prediction
// from X is at
//   p_X + v_X (t − s_X) − p_R − v_R (t − s_R)
//     = (p_X − p_R) + v_R (s_R − s_X) + (v_X − v_R)(t − s_X),
// and ½ a_X (t − s_X)² farther on.
void SeeFrom(const motion::SpaceTimeBound& frame, const motion::SpaceTimeBound& bound, Instant base,
             numeric::MovingBall* ball) {
  const motion::MotionState &r = frame.state, &x = bound.state;
  const numeric::IntervalVector v_R(r.v_WA);
  const numeric::IntervalVector w = numeric::IntervalVector(x.v_WA) - v_R;
  const numeric::Interval since = numeric::SecondsBetween(x.stamp, base);
  ball->anchor = (numeric::IntervalVector(x.p_WA) - numeric::IntervalVector(r.p_WA)) +
                 numeric::SecondsBetween(x.stamp, r.stamp) * v_R;
  ball->velocity = w;
  ball->shift = since * w;
  if (!ball->bends) return;
  ball->velocity = w + since * numeric::IntervalVector(x.a_WA);
  ball->shift = ball->shift + Square(since) * ball->bend;
}

BodySegment SegmentOf(const KnownMotion& motion, const motion::SpaceTimeBound& frame,
                      Instant base) {
  BodySegment segment;
  segment.shape = motion.shape;
  for (const auto* known : {&motion.last, &motion.next}) {
    if (!known->has_value()) continue;
    const motion::SpaceTimeBound& bound = **known;
    const bool ahead = known == &motion.last;
    segment.ball.radius = bound.limits.radius;
    segment.ball.bounds.push_back(ahead ? ForwardBall(bound, base) : BackwardBall(bound, base));
    SeeFrom(frame, bound, base, &segment.ball.bounds.back());
    if (!segment.shape) continue;
    segment.turns.push_back(ahead ? ForwardRotation(bound, base) : BackwardRotation(bound, base));
  }
  return segment;
}

}  // namespace

BodyPair SegmentsOf(const KnownMotion& a, const KnownMotion& b, Instant from) {
  const motion::SpaceTimeBound& frame = a.last ? *a.last : *a.next;
  return {SegmentOf(a, frame, from), SegmentOf(b, frame, from)};
}

TimeOfContactResult TimeOfContact(const KnownMotion& a, const KnownMotion& b, const TimeSpan& span,
                                  const ContactTolerance& tolerance, WorkBudget* work) {
  CORE_CHECK(span.from <= span.to, "a span of time does not end before it begins",
             span.from.nanoseconds(), span.to.nanoseconds());
  const BodyPair bodies = SegmentsOf(a, b, span.from);
  return TimeOfContact(bodies.a, bodies.b, numeric::SecondsBetween(span.from, span.to).upper,
                       tolerance, work);
}

}  // namespace collision::narrow_phase
