#include "collision_core/narrow_phase/approach/closest_approach.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "collision_core/narrow_phase/contact/contact_proximity.h"
#include "collision_core/narrow_phase/contact/shape_motion.h"
#include "collision_core/numeric/rounding.h"

namespace collision::narrow_phase {
namespace {

// The search ends where the lower bound is less than what the instants that were examined allow by
// no more than a share of the distance, of the bodies' size, or of what is not known at them.
constexpr double kBallShare = 0x1p-20;
constexpr double kShapeShare = 0x1p-6;
constexpr double kSizeShare = 0x1p-24;
constexpr double kUncertainShare = 0x1p-3;

// Spans shorter than this share of the segment are not halved; the first and the last one in which
// the two may be nearest are halved down to the other.
constexpr double kShortest = 0x1p-40;
constexpr double kTimeShare = 0x1p-8;

// What a span of two balls costs, in units of work.
constexpr std::uint64_t kBallSpanUnits = 2;

// A lower bound of |d| over the span: see the head of closest_approach.h.
double CentresApart(const numeric::MovingBall& difference, double from, double to) {
  const double middle = from + 0.5 * (to - from);
  const double h = std::max(numeric::AddUp(to, -middle), numeric::AddUp(middle, -from));
  const numeric::IntervalVector d = difference.centre() + difference.PathTo(middle);
  const Eigen::Vector3d direction = d.middle();
  const double length = direction.norm();
  if (!(length > 0) || !(length < numeric::kInfinity)) return 0;
  const numeric::IntervalVector n(direction / length);
  const numeric::Interval speed = numeric::Abs(Dot(n, difference.VelocityAt(middle)));
  const numeric::Interval bend = numeric::Max(0, -Dot(n, difference.bend));
  const numeric::Interval along = Dot(n, d) - h * (speed + numeric::Interval(h) * bend);
  return std::max(0.0, (along / numeric::Norm(n)).lower);
}

// How far two balls are apart: the best of all choices of one bound of each, which all hold.
class BallsApart {
 public:
  BallsApart(const BallSegment& a, const BallSegment& b)
      : radii_(numeric::Interval(a.radius) + b.radius) {
    for (const numeric::MovingBall& ball_a : a.bounds) {
      for (const numeric::MovingBall& ball_b : b.bounds) {
        differences_.push_back(Difference(ball_a, ball_b, 0));
      }
    }
  }

  numeric::Interval At(double t) const {
    numeric::Interval apart(-numeric::kInfinity, numeric::kInfinity);
    for (const numeric::MovingBall& difference : differences_) {
      const numeric::Interval u = difference.u.At(t);
      const numeric::Interval distance =
          numeric::Norm(difference.centre() + difference.PathTo(t)) - radii_;
      apart = {std::max(apart.lower, (distance - u).lower),
               std::min(apart.upper, (distance + u).upper)};
    }
    return apart;
  }

  // At least, all the time.
  double Throughout(double from, double to) const {
    double lower = -numeric::kInfinity;
    for (const numeric::MovingBall& difference : differences_) {
      const numeric::Interval u = numeric::Max(difference.u.At(from), difference.u.At(to));
      const numeric::Interval apart =
          numeric::Interval(CentresApart(difference, from, to)) - (radii_ + u);
      lower = std::max(lower, apart.lower);
    }
    return lower;
  }

 private:
  const numeric::Interval radii_;
  std::vector<numeric::MovingBall> differences_;
};

class ApproachSearch {
 public:
  ApproachSearch(const BodySegment& a, const BodySegment& b, const ApproachQuery& query,
                 WorkBudget* work)
      : a_(a), b_(b), query_(query), work_(*work), balls_(a.ball, b.ball) {
    if (!a.awaited && !b.awaited && !(a.is_ball() && b.is_ball())) motion_.emplace(a, b, work);
  }

  ClosestApproach Run() {
    Examine(query_.duration);
    Add({0, query_.duration, -numeric::kInfinity});
    if (!spans_.empty()) Examine(0);
    while (!spans_.empty() && !work_.exhausted() && !IsNarrow()) Halve(Take());
    while (!work_.exhausted() && NarrowTime()) continue;
    return Result();
  }

 private:
  struct Span {
    double from, to;
    double lower;  // the distance is at least this within it
  };
  static bool Farther(const Span& x, const Span& y) { return x.lower > y.lower; }

  bool shapes() const { return motion_.has_value(); }

  // Bounds a span and keeps it, if the nearest instant may lie in it.
  void Add(Span span) {
    work_.Spend(kBallSpanUnits);
    span.lower = std::max(span.lower, balls_.Throughout(span.from, span.to));
    if (span.lower > Limit()) return Skip(span);
    span.lower = std::max(span.lower, Examine(span));
    if (span.lower > Limit()) return Skip(span);
    spans_.push_back(span);
    std::push_heap(spans_.begin(), spans_.end(), Farther);
  }

  void Halve(const Span& span) {
    if (!(span.to - span.from > kShortest * query_.duration)) return final_.push_back(span);
    const double middle = span.from + 0.5 * (span.to - span.from);
    Add({span.from, middle, span.lower});
    Add({middle, span.to, span.lower});
  }

  // Halves the longer one of the first and the last span in which the two may be nearest. Returns
  // false if both are short.
  bool NarrowTime() {
    if (query_.continued && (nearest_at_ <= 0 || nearest_at_ >= query_.duration)) return false;
    std::erase_if(spans_, [this](const Span& span) { return span.lower > Limit(); });
    if (spans_.empty() || (shapes() && upper_ <= 0)) return false;
    const auto by_time = [](const Span& x, const Span& y) { return x.from < y.from; };
    const auto [first, last] = std::minmax_element(spans_.begin(), spans_.end(), by_time);
    const auto longer = first->to - first->from > last->to - last->from ? first : last;
    const Span span = *longer;
    if (!(span.to - span.from > kTimeShare * query_.duration)) return false;
    spans_.erase(longer);
    Halve(span);
    return true;
  }

  void Skip(const Span& span) { skipped_ = std::min(skipped_, span.lower); }

  Span Take() {
    std::pop_heap(spans_.begin(), spans_.end(), Farther);
    const Span span = spans_.back();
    spans_.pop_back();
    return span;
  }

  // Nothing beyond it is of interest.
  double Limit() const { return std::min(upper_, query_.beyond); }

  void Examine(double at) { Examine({at, at, -numeric::kInfinity}); }

  // Examines the middle of the span. Returns what shapes are apart by throughout the span.
  double Examine(const Span& span) {
    const double at = span.from + 0.5 * (span.to - span.from);
    const numeric::Interval balls = balls_.At(at);
    if (!shapes()) {
      if (a_.is_ball() && b_.is_ball()) Take(at, balls);
      return -numeric::kInfinity;
    }
    if (balls.lower > Limit()) return -numeric::kInfinity;
    ShapeMotion::PoseQuery query = motion_->QuerySeparation(at, Goal::kNearest);
    motion_->CheckContainment(&query);
    Take(at, ProximityFrom(query, *motion_, a_.ball.radius + b_.ball.radius).separation);
    return motion_->DistanceOver(query, span.from, span.to);
  }

  void Take(double at, numeric::Interval separation) {
    if (separation.upper < upper_) nearest_at_ = at;
    upper_ = std::min(upper_, separation.upper);
    lower_ = std::min(lower_, separation.lower);
  }

  // Whether nothing is gained by going on. Of shapes that touch no more is asked.
  bool IsNarrow() const {
    if (shapes() && upper_ <= 0) return true;
    const double size = a_.ball.radius + b_.ball.radius;
    const double share = shapes() ? kShapeShare : kBallShare;
    const double enough = std::max(
        {share * std::abs(upper_), kSizeShare * size, kUncertainShare * (upper_ - lower_)});
    return !(lower_ - spans_.front().lower > enough);
  }

  ClosestApproach Result() {
    spans_.insert(spans_.end(), final_.begin(), final_.end());
    ClosestApproach closest{{query_.duration, 0}, {skipped_, upper_}};
    for (const Span& span : spans_) {
      if (span.lower > Limit()) continue;
      closest.at.lower = std::min(closest.at.lower, span.from);
      closest.at.upper = std::max(closest.at.upper, span.to);
      closest.distance.lower = std::min(closest.distance.lower, span.lower);
    }
    if (closest.at.lower > closest.at.upper) closest.at = {0, query_.duration};
    // Two bounds that contradict each other: one of them was broken.
    closest.distance.lower = std::min(closest.distance.lower, closest.distance.upper);
    return closest;
  }

  const BodySegment& a_;
  const BodySegment& b_;
  const ApproachQuery query_;
  WorkBudget& work_;
  const BallsApart balls_;
  std::optional<ShapeMotion> motion_;  // of shapes that are known
  std::vector<Span> spans_;            // a heap: the one that may be nearest first
  std::vector<Span> final_;            // too short to be halved
  double skipped_ = numeric::kInfinity;
  double upper_ = numeric::kInfinity;  // of the least distance
  double nearest_at_ = 0;              // where that was found
  double lower_ = numeric::kInfinity;  // of the distance at any instant examined: none is better
};

}  // namespace

ClosestApproach FindClosestApproach(const BodySegment& a, const BodySegment& b,
                                    const ApproachQuery& query, WorkBudget* work) {
  return ApproachSearch(a, b, query, work).Run();
}

}  // namespace collision::narrow_phase
