#include "collision_core/narrow_phase/contact/time_of_contact.h"

#include <algorithm>

#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/contact/ball_contact.h"
#include "collision_core/narrow_phase/contact/ball_proximity.h"
#include "collision_core/narrow_phase/contact/contact_boundary.h"
#include "collision_core/narrow_phase/pose/segment_pose.h"

namespace collision::narrow_phase {
namespace {

// Shares of the work that is left: for the free time from the start, then for that from the end,
// then for the begin of contact; the rest is for its end.
constexpr double kForwardShare = 0.5;
constexpr double kBackwardShare = 0.4;
constexpr double kBeginShare = 0.6;

// Contact may be over sooner than the tolerance asked for, and freedom not be followed up to it.
// Where there is no answer as narrow as asked for, it is sought with this share of the tolerance,
// and with the same share of that, down to kFinest of the time.
constexpr double kFiner = 0x1p-20;
constexpr double kFinest = 1e-12;

// What the evaluation of two balls costs.
constexpr std::uint64_t kBallPairUnits = 20;

TimeOfContactResult Free(double duration) {
  TimeOfContactResult free;
  free.status = ContactStatus::kFree;
  free.begin = free.end = {duration, duration};
  return free;
}

bool IsNarrow(numeric::Interval bracket, const ContactTolerance& tolerance) {
  return bracket.width() <= std::max(tolerance.absolute, tolerance.relative * bracket.upper);
}

class ContactSearch {
 public:
  ContactSearch(const BodySegment& a, const BodySegment& b, double duration,
                const ContactTolerance& tolerance, WorkBudget* work)
      : motion_(a, b, work), duration_(duration), tolerance_(tolerance), work_(*work) {}

  TimeOfContactResult Run(const SegmentResult& balls) {
    found_.begin.lower = std::max(0.0, balls.free_until);
    found_.end.upper = std::min(duration_, balls.free_from);
    for (ContactTolerance finer = tolerance_; Search(finer);) {
      if (IsAnswered() || exhausted_ || IsFinest(finer)) return Result();
      finer = {kFiner * finer.absolute, kFiner * finer.relative};
    }
    return Free(duration_);
  }

 private:
  bool IsContact() const { return found_.status == ContactStatus::kContact; }

  bool IsAnswered() const {
    return IsContact() && IsNarrow(found_.begin, tolerance_) && IsNarrow(found_.end, tolerance_);
  }

  bool IsFinest(const ContactTolerance& tolerance) const {
    const double time = std::max(found_.end.upper, kFinest * duration_);
    return std::max(tolerance.absolute, tolerance.relative * time) <= kFinest * time;
  }

  // Continues the search from what was found. Returns false if the bodies are apart throughout.
  bool Search(const ContactTolerance& tolerance) {
    ContactBoundary forward(motion_, duration_, tolerance, TimeDirection::kForward, &work_);
    ContactBoundary backward(motion_, duration_, tolerance, TimeDirection::kBackward, &work_);
    double &first = found_.begin.lower, &last = found_.end.upper;
    {
      const WorkShare share(kForwardShare, &work_);
      first = forward.FreeFrom(first);
    }
    if (first == numeric::kInfinity) return false;
    {
      const WorkShare share(kBackwardShare, &work_);
      last = backward.FreeFrom(last);
    }
    if (last < first) return false;  // -infinity, or the two advances met
    FindContact(&forward, &backward);
    nearest_ = std::min({nearest_, forward.nearest(), backward.nearest()});
    exhausted_ = exhausted_ || forward.exhausted() || backward.exhausted();
    uncertain_ = forward.uncertain() || backward.uncertain();
    orientation_unknown_ = forward.orientation_unknown() || backward.orientation_unknown();
    return true;
  }

  void FindContact(ContactBoundary* forward, ContactBoundary* backward) {
    numeric::Interval &begin = found_.begin, &end = found_.end;
    const bool known = IsContact();
    if (!known || !IsNarrow(begin, tolerance_)) {
      const WorkShare share(kBeginShare, &work_);
      const auto touching = forward->ContactAfter(begin.lower, known ? begin.upper : end.upper);
      if (!touching && !known) return;
      begin.upper = touching.value_or(begin.upper);
      if (!known) end.lower = begin.upper;
      found_.status = ContactStatus::kContact;
    }
    if (known && IsNarrow(end, tolerance_)) return;
    end.lower = backward->ContactAfter(end.upper, end.lower).value_or(end.lower);
  }

  TimeOfContactResult Result() {
    if (!IsContact()) {
      found_.begin.upper = found_.end.upper;
      found_.end.lower = found_.begin.lower;
      found_.within = nearest_;
    }
    found_.limited_by = Limit();
    return found_;
  }

  BracketLimit Limit() const {
    if (IsAnswered()) return BracketLimit::kNone;
    if (exhausted_ && !orientation_unknown_) return BracketLimit::kBudget;
    return uncertain_ || orientation_unknown_ ? BracketLimit::kMotion : BracketLimit::kGeometry;
  }

  const ShapeMotion motion_;
  const double duration_;
  const ContactTolerance tolerance_;
  WorkBudget& work_;
  TimeOfContactResult found_;
  double nearest_ = numeric::kInfinity;
  bool exhausted_ = false, uncertain_ = false, orientation_unknown_ = false;
};

// The result for two balls is as narrow as rounding and the motion allow.
TimeOfContactResult OfBalls(const BodySegment& a, const BodySegment& b, double duration,
                            const SegmentResult& balls, const ContactTolerance& tolerance) {
  if (balls.free_until == numeric::kInfinity || balls.free_from == -numeric::kInfinity ||
      balls.free_from < balls.free_until) {
    return Free(duration);
  }
  TimeOfContactResult found;
  const double first = std::max(0.0, balls.free_until);
  const double last = std::max(first, std::min(duration, balls.free_from));
  found.begin = found.end = {first, last};
  if (balls.contact_from <= balls.contact_to) {
    found.status = ContactStatus::kContact;
    found.begin.upper = std::max(first, balls.contact_from);
    found.end.lower = std::min(last, balls.contact_to);
    if (IsNarrow(found.begin, tolerance) && IsNarrow(found.end, tolerance)) return found;
  } else {
    found.within = numeric::kInfinity;
    for (const double at : {first, first + 0.5 * (last - first), last}) {
      const double upper = BallProximity(a.ball, b.ball, at).separation.upper;
      found.within = std::min(found.within, std::max(0.0, upper));
    }
  }
  const BoundChoice choice = BestBounds(a, b, first);
  const bool unknown = !choice.certain || PoseAt(a, b, choice, first).translation >
                                              kExactMotion * (a.ball.radius + b.ball.radius);
  found.limited_by = unknown ? BracketLimit::kMotion : BracketLimit::kGeometry;
  return found;
}

}  // namespace

TimeOfContactResult TimeOfContact(const BodySegment& a, const BodySegment& b, double duration,
                                  const ContactTolerance& tolerance, WorkBudget* work) {
  CORE_CHECK(!a.awaited && !b.awaited, "the shapes of both bodies are known");
  const std::uint64_t before = work->spent();
  work->Spend(kBallPairUnits);
  const SegmentResult balls = EvaluateBallSegment(a.ball, b.ball, duration);
  TimeOfContactResult found;
  if (a.is_ball() && b.is_ball()) {
    found = OfBalls(a, b, duration, balls, tolerance);
  } else if (balls.free_until == numeric::kInfinity || balls.free_from == -numeric::kInfinity) {
    found = Free(duration);
  } else {
    found = ContactSearch(a, b, duration, tolerance, work).Run(balls);
  }
  found.work = work->spent() - before;
  return found;
}

}  // namespace collision::narrow_phase
