#include "collision_core/narrow_phase/contact_time.h"

#include <algorithm>
#include <cmath>

#include "collision_core/narrow_phase/ball_proximity.h"
#include "collision_core/narrow_phase/contact_edge.h"

namespace collision {
namespace {

// Of the work that is left: for how long the two are free from the start, then from the end, then
// for the begin of contact; the rest is for its end.
constexpr double kForwardShare = 0.5;
constexpr double kBackwardShare = 0.4;
constexpr double kBeginShare = 0.6;

// What the verdict on two balls costs.
constexpr std::uint64_t kBallPairUnits = 20;

// What is not known of the motion counts where it is more than rounding, as a share of the size.
constexpr double kRoundingShare = 1e-12;

ContactTime Free(double duration) {
  ContactTime free;
  free.status = ContactStatus::kFree;
  free.begin = free.end = {duration, duration};
  return free;
}

bool IsNarrow(Interval bracket, const ContactTolerance& tolerance) {
  return bracket.width() <= std::max(tolerance.absolute, tolerance.relative * bracket.upper);
}

class ContactSearch {
 public:
  ContactSearch(const BodySegment& a, const BodySegment& b, double duration,
                const ContactTolerance& tolerance, Work* work)
      : motion_(a, b, work),
        duration_(duration),
        tolerance_(tolerance),
        forward_(motion_, duration, tolerance, false, work),
        backward_(motion_, duration, tolerance, true, work),
        work_(*work) {}

  ContactTime Run(const SegmentVerdict& balls) {
    double first, last;
    std::optional<double> begin;
    {
      const WorkShare share(kForwardShare, &work_);
      first = forward_.FreeFrom(std::max(0.0, balls.free_until));
    }
    if (first == kInfinity) return Free(duration_);
    {
      const WorkShare share(kBackwardShare, &work_);
      last = backward_.FreeFrom(std::min(duration_, balls.free_from));
    }
    if (last == -kInfinity || last < first) return Free(duration_);  // the two advances met
    ContactTime found;
    found.begin = found.end = {first, last};
    {
      const WorkShare share(kBeginShare, &work_);
      begin = forward_.ContactAfter(first, last);
    }
    if (begin) {
      found.status = ContactStatus::kContact;
      found.begin.upper = *begin;
      found.end.lower = backward_.ContactAfter(last, *begin).value_or(*begin);
    }
    found.within = begin ? 0 : std::min(forward_.nearest(), backward_.nearest());
    found.limited_by = Limit(found);
    return found;
  }

 private:
  EventLimit Limit(const ContactTime& found) const {
    if (found.status == ContactStatus::kContact && IsNarrow(found.begin, tolerance_) &&
        IsNarrow(found.end, tolerance_)) {
      return EventLimit::kNone;
    }
    if (forward_.exhausted() || backward_.exhausted()) return EventLimit::kBudget;
    return forward_.uncertain() || backward_.uncertain() ? EventLimit::kMotion
                                                         : EventLimit::kGeometry;
  }

  const ShapeMotion motion_;
  const double duration_;
  const ContactTolerance tolerance_;
  ContactEdge forward_, backward_;
  Work& work_;
};

// The balls' own verdict is as narrow as rounding and the motion allow.
ContactTime OfBalls(const BodySegment& a, const BodySegment& b, double duration,
                    const SegmentVerdict& balls, const ContactTolerance& tolerance) {
  if (balls.free_until == kInfinity || balls.free_from == -kInfinity ||
      balls.free_from < balls.free_until) {
    return Free(duration);
  }
  ContactTime found;
  const double first = std::max(0.0, balls.free_until);
  const double last = std::max(first, std::min(duration, balls.free_from));
  found.begin = found.end = {first, last};
  if (balls.contact_from <= balls.contact_to) {
    found.status = ContactStatus::kContact;
    found.begin.upper = std::max(first, balls.contact_from);
    found.end.lower = std::min(last, balls.contact_to);
    if (IsNarrow(found.begin, tolerance) && IsNarrow(found.end, tolerance)) return found;
  } else {
    found.within = kInfinity;
    for (const double at : {first, first + 0.5 * (last - first), last}) {
      const double upper = BallProximity(a.ball, b.ball, at).separation.upper;
      found.within = std::min(found.within, std::max(0.0, upper));
    }
  }
  const BoundChoice choice = BestBounds(a, b, first);
  const bool unknown = !choice.certain || PoseAt(a, b, choice, first).translation >
                                              kRoundingShare * (a.ball.radius + b.ball.radius);
  found.limited_by = unknown ? EventLimit::kMotion : EventLimit::kGeometry;
  return found;
}

}  // namespace

ContactTime TimeOfContact(const BodySegment& a, const BodySegment& b, double duration,
                          const ContactTolerance& tolerance, Work* work) {
  const std::uint64_t before = work->spent();
  work->Spend(kBallPairUnits);
  const SegmentVerdict balls = JudgeSegment(a.ball, b.ball, duration);
  ContactTime found;
  if (a.is_ball() && b.is_ball()) {
    found = OfBalls(a, b, duration, balls, tolerance);
  } else if (balls.free_until == kInfinity || balls.free_from == -kInfinity) {
    found = Free(duration);
  } else {
    found = ContactSearch(a, b, duration, tolerance, work).Run(balls);
  }
  found.work = work->spent() - before;
  return found;
}

}  // namespace collision
