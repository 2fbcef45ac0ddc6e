#include "collision_core/narrow_phase/contact/shape_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision_core/narrow_phase/contact/contact_boundary.h"

namespace collision::narrow_phase {
namespace {

using PoseQuery = ShapeMotion::PoseQuery;

// An advance ends where its steps are shorter than this share of the segment.
constexpr double kResolution = 1e-6;

// Contact that is certain for less than this share of the segment is followed no further.
constexpr double kShortestStep = 1e-10;

// The direction is told where the gap is this many times what is uncertain, if there is such an
// instant: nearer it is not known, farther it is of another time. DeviationOf() makes it 0.19 rad.
constexpr double kTellingGap = 128;

// At least so long before the first possible touch, as a share of the segment.
constexpr double kNormalBefore = 1e-3;

// An instant whose pose is so many times better known is preferred, though it is earlier.
constexpr double kMuchBetter = 16;

// Contact is looked for from this share of the segment after the last certain freedom on, and when
// it is found between two looks, so often half-way between them.
constexpr double kFirstStep = 1e-4;
constexpr double kStepGrowth = 4;
constexpr int kHalvings = 5;

// A witness of contact that lasts for less than this share of the step before is not the best
// one.
constexpr double kFallenShort = 0.25;

// What is not certified free is searched for contact at its ends, and at the halves, quarters, … of
// it from either end: down to 1/2^kSearchDepth.
constexpr int kSearchDepth = 8;

// Contact that is found so much later than what is not known of the motion explains, and by more
// than this share of the segment, is looked for again, by points near where the two touch first.
constexpr double kLate = 4;
constexpr double kLateShare = 1e-5;
constexpr double kFineShare = 1e-9;

// Of the work that is left: for all that is about times, so that something remains for the depth;
// in there for how long the two are free from the start, then from the end, then for the direction
// in which they came near; the rest is for contact.
constexpr double kTimesShare = 0.9;
constexpr double kForwardShare = 0.4;
constexpr double kBackwardShare = 0.3;
constexpr double kDirectionShare = 0.6;

// Covers a dozen roundings of a result, each 2^-53 of it, a thousand times over.
constexpr double kRounding = 1e-12;

// The rounding of the directions that are compared and turned into the world [rad]: a few dozen
// units of 2^-53.
constexpr double kDirectionRounding = 1e-12;

// The rounding of a point's distance from the reference point [m]: 2.5 · 2^-53 of that distance, so
// enough up to 3 km.
constexpr double kLengthRounding = 1e-12;

// A bound on the angle whose sine is x: the tangent is no smaller, and where x is near 1, so that
// 1 − x² loses digits, far larger. π where x is no sine.
double AngleOfSine(double x) {
  if (!(x < 1)) return std::numbers::pi;
  return std::min(std::numbers::pi, x / std::sqrt(1 - x * x) * (1 + kRounding));
}

// The shortest way between two convex sets is unique. Where points of the sets are displaced by at
// most u relative to each other it changes, as a vector, by at most u + 2 √(u (d + u)): with v, v'
// the shortest differences before and after, some difference w before lies within u of v', and
// v·(w − v) >= 0, so |w − v|² <= |w|² − |v|² <= (|v| + 2u)² − |v|². Likewise a way of length
// at most U differs from the shortest one, at least L long, by at most √(U² − L²).
double DeviationOf(const NearestWay& way, double translation) {
  const double lower = std::max(0.0, way.lower), upper = std::max(lower, way.upper);
  const double u = translation + (upper - lower);
  return std::sqrt((upper - lower) * (upper + lower)) + u + 2 * std::sqrt(u * (upper + u));
}

// One of the ways is the shortest: how far may it point away from the one taken?
ContactNormal NormalOf(const PoseQuery& instance) {
  ContactNormal normal;
  const std::vector<NearestWay>& ways = instance.bracket.ways;
  if (ways.empty()) return normal;
  const auto shortest = std::min_element(
      ways.begin(), ways.end(), [](const auto& x, const auto& y) { return x.upper < y.upper; });
  const Eigen::Vector3d taken = (shortest->b - shortest->a).normalized();
  double error = 0;
  for (const NearestWay& way : ways) {
    const Eigen::Vector3d v = way.b - way.a;
    const double length = v.norm();
    if (!(length > 0)) return normal;
    const double half_chord = (v / length - taken).norm() / 2;
    const double apart = 2 * AngleOfSine(half_chord);
    error =
        std::max(error, apart + AngleOfSine(DeviationOf(way, instance.pose.translation) / length));
  }
  normal.known = true;
  normal.normal = instance.pose.R_WA * taken;
  normal.error =
      std::min(std::numbers::pi, error + instance.pose.matrix_error + kDirectionRounding);
  return normal;
}

EventLimit LimitOf(const PoseQuery& instance, double size) {
  if (instance.bracket.exhausted) return EventLimit::kBudget;
  return instance.uncertainty > kExactMotion * size ? EventLimit::kMotion : EventLimit::kGeometry;
}

// Moved by so much along the line of their reference points, two bodies within balls of radii that
// add up to `size` are apart.
double DepthMax(const RelativePose& pose, double size) {
  const double off = pose.offset_error + pose.translation;
  return std::max(0.0, size * (1 + kRounding) + off - pose.p_AB.norm() * (1 - kRounding));
}

Proximity ProximityFrom(const PoseQuery& instance, const ShapeMotion& motion, double size) {
  Proximity proximity;
  if (!instance.choice.certain) return proximity;
  const RelativePose& pose = instance.pose;
  const SeparationBracket& bracket = instance.bracket;
  proximity.separation = {numeric::AddDown(bracket.lower, -pose.translation),
                          numeric::AddUp(bracket.upper, pose.translation)};
  if (instance.touching()) proximity.separation.upper = std::min(proximity.separation.upper, 0.0);
  if (!instance.apart() || !instance.neither_inside) {
    const double depth = std::min(DepthMax(pose, size), motion.DepthAtMost(instance));
    proximity.separation.lower = std::min(proximity.separation.upper, -depth);
  }
  proximity.depth_lower = std::max(0.0, -proximity.separation.upper);
  proximity.p_WC = pose.p_WA + pose.R_WA * bracket.point;
  proximity.point_error = numeric::AddUp(
      numeric::AddUp(bracket.point_error, pose.error_A),
      numeric::AddUp(pose.translation,
                     numeric::MultiplyUp(pose.chord_A,
                                         numeric::AddUp(bracket.point.norm(), kLengthRounding))));
  // A guess, and told as one.
  const Eigen::Vector3d between = pose.R_WA * pose.p_AB;
  if (between.norm() > 0) proximity.normal = between.normalized();
  proximity.level = bracket.level;
  proximity.limited_by = LimitOf(instance, size);
  return proximity;
}

class SegmentEvaluation {
 public:
  SegmentEvaluation(const BodySegment& a, const BodySegment& b, double duration, WorkBudget* work)
      : motion_(a, b, work),
        duration_(duration),
        size_(a.ball.radius + b.ball.radius),
        work_(*work) {}

  /// From `at` on, towards the end or the start: how far the two stay apart. ±infinity: throughout.
  double FreeFrom(double at, TimeDirection direction) {
    ContactBoundary edge =
        ContactBoundary::Coarse(motion_, duration_, kResolution * duration_, direction, &work_);
    const double free = edge.FreeFrom(at);
    nested_ = nested_ || edge.nested();
    exhausted_ = exhausted_ || edge.exhausted();
    if (direction == TimeDirection::kForward && std::isfinite(free))
      Remember(edge.touch(), at, free);
    return free;
  }

  /// Certain contact in [f, g], which is not certified free.
  void FindContact(double f, double g, SegmentResult* times) {
    if (FollowLeaves(f, g, times)) return;
    if (TryContact(f, g, f, times) || TryContact(f, g, g, times)) return;
    double width = g - f;
    for (int depth = 1; depth <= kSearchDepth; ++depth) {
      width /= 2;
      if (TryContact(f, g, f + width, times)) return;
      if (depth > 1 && TryContact(f, g, g - width, times)) return;
    }
  }

  /// Contact at [f, g]'s ends where FindContact() saw it late: edges that coincide, for example.
  void Sharpen(double f, double g, SegmentResult* times) {
    const bool found = times->contact_from <= times->contact_to;
    if (found ? times->contact_from > f : f > 0) {
      SharpenEnd(f, found ? times->contact_from : g, TimeDirection::kForward, times);
    }
    if (found && times->contact_to < g && g < duration_) {
      SharpenEnd(g, times->contact_to, TimeDirection::kBackward, times);
    }
  }

  /// Of an instant shortly before the two may have touched for the first time.
  ContactNormal Normal() {
    if (!approach_ || work_.exhausted()) return {};
    const PoseQuery end = motion_.RecheckWitness(approach_->to, {});
    if (!end.choice.certain) return {};
    // At a state's stamp the pose is known much better than between two states.
    if (work_.exhausted()) return {};
    const PoseQuery start = motion_.RecheckWitness(approach_->from, {});
    if (work_.exhausted()) return {};
    if (start.choice.certain && kMuchBetter * start.uncertainty <= end.uncertainty) {
      return NormalOf(motion_.QuerySeparation(approach_->from, Goal::kNearest, leaves_));
    }
    const double gap = kTellingGap * end.uncertainty;
    const double back = std::max(kNormalBefore * duration_, gap / motion_.SpeedAt(end));
    const double before = std::max(approach_->from, approach_->to - back);
    const ContactNormal near = NormalOf(motion_.QuerySeparation(before, Goal::kNearest, leaves_));
    if (near.tells() || before == approach_->from || work_.exhausted()) return near;
    const ContactNormal far =
        NormalOf(motion_.QuerySeparation(approach_->from, Goal::kNearest, leaves_));
    return far.known && (!near.known || far.error < near.error) ? far : near;
  }

  /// Something is said of an instant, however little may be spent.
  void QueryOnce(double at) {
    if (!nearest_) QueryAt(at, TimeDirection::kForward);
  }

  const std::optional<PoseQuery>& nearest() const { return nearest_; }
  /// Requires nearest().
  Proximity NearestProximity() {
    motion_.CheckContainment(&*nearest_);
    return ProximityFrom(*nearest_, motion_, size_);
  }
  bool exhausted() const { return exhausted_; }

 private:
  struct Approach {
    double from, to;  // apart in between
  };

  void SharpenEnd(double free, double until, TimeDirection direction, SegmentResult* times) {
    if (std::abs(until - free) <= kLateShare * duration_ || Exhausted()) return;
    const PoseQuery instance = motion_.RecheckWitness(free, {});
    if (!instance.choice.certain) return;
    const double late = kLate * instance.uncertainty / motion_.SpeedAt(instance);
    if (!(std::abs(until - free) > late)) return;
    ContactBoundary edge(motion_, duration_, {kFineShare * duration_, 0}, direction, &work_);
    const std::optional<double> touching = edge.ContactByCandidates(free, until);
    if (!touching) return;
    const double lasts = edge.LastsFrom(*touching, until);
    const bool found = times->contact_from <= times->contact_to;
    if (found && lasts != until) times->contact_continuous = false;
    if (!found) times->contact_to = lasts;
    const bool backward = direction == TimeDirection::kBackward;
    (backward ? times->contact_to : times->contact_from) = *touching;
  }

  void Remember(const ImpactBound& touch, double start, double at) {
    if (touch.resolved) leaves_ = {ContactWitness::Kind::kLeaves, touch.leaf_A, touch.leaf_B};
    if (at > start) approach_ = Approach{start, at};
  }

  // The leaves that may touch first are likely to: when do their triangles cross for certain? At f,
  // where contact goes on from before; else at growing distances from it, then nearer by halves.
  bool FollowLeaves(double f, double g, SegmentResult* times) {
    if (leaves_.kind == ContactWitness::Kind::kNone || Exhausted()) return false;
    witness_ = {};
    const auto touches = [&](double place) {
      const PoseQuery instance = motion_.RecheckWitness(place, leaves_);
      if (instance.touching()) witness_ = instance.bracket.witness;
      return instance.touching();
    };
    double before = f, at = f;
    bool found = touches(f);
    const bool at_once = found;
    // Contact that goes on from before may be certain at the start by anything else.
    if (f <= 0 && !found && TryContact(f, g, f, times)) return true;
    for (double step = kFirstStep * duration_; !found; step *= kStepGrowth) {
      if (at >= g || Exhausted()) return false;
      before = at;
      at = std::min(g, f + step);
      found = touches(at);
    }
    for (int i = 0; i < kHalvings && !at_once && !Exhausted(); ++i) {
      const double middle = before + (at - before) / 2;
      (touches(middle) ? at : before) = middle;
    }
    TakeContact(at, at, g, times);
    return true;
  }

  // Contact is certain at `place`, and on from `from` to there.
  void TakeContact(double from, double place, double g, SegmentResult* times) {
    times->contact_from = from;
    times->contact_to = Extend(place, TimeDirection::kForward);
    if (times->contact_to < g && g >= duration_) QueryEnd(times);
  }

  // Is contact certain at `place`? Then so it is for some time before and after.
  bool TryContact(double f, double g, double place, SegmentResult* times) {
    if (Exhausted()) return false;
    const TimeDirection side = place != f ? TimeDirection::kBackward : TimeDirection::kForward;
    const PoseQuery instance = QueryAt(place, side);
    if (!instance.touching()) return false;
    witness_ = instance.bracket.witness;
    TakeContact(Extend(place, TimeDirection::kBackward), place, g, times);
    return true;
  }

  // Both advances end where contact is looked for first.
  PoseQuery& QueryAt(double at, TimeDirection direction) {
    const bool backward = direction == TimeDirection::kBackward;
    std::optional<PoseQuery>& last = backward ? last_backward_ : last_forward_;
    if (last && last->at == at) return *last;
    last = motion_.QuerySeparation(at, Goal::kDecision);
    if (nested_) motion_.CheckContainment(&*last);
    RememberNearest(*last);
    return *last;
  }

  // How far contact is certain from here on, without a gap. What makes it certain at one instant is
  // looked at again at the next; where that falls short something else is looked for.
  double Extend(double at, TimeDirection direction) {
    const bool backward = direction == TimeDirection::kBackward;
    ContactWitness witness = witness_;
    double longest = 0;
    while (!Exhausted()) {
      PoseQuery instance = motion_.RecheckWitness(at, witness);
      double lasts = instance.touching() ? motion_.ContactStep(instance, direction) : 0;
      if (lasts <= kFallenShort * longest || lasts == 0) {
        instance = motion_.QuerySeparation(at, Goal::kContact);
        if (nested_) motion_.CheckContainment(&instance);
        RememberNearest(instance);
        if (!instance.touching()) break;
        witness = instance.bracket.witness;
        const double other = motion_.ContactStep(instance, direction);
        // Nothing else lasts longer: where contact ends.
        if (other <= lasts && other <= kResolution * duration_) break;
        lasts = std::max(lasts, other);
        longest = 0;
      }
      longest = std::max(longest, lasts);
      at = backward ? numeric::AddUp(at, -lasts) : numeric::AddDown(at, lasts);
      if (backward && at <= 0) return 0;
      if (!backward && at >= duration_) return duration_;
      // Away from where contact began the steps grow, however short the first ones are.
      if (lasts <= kShortestStep * duration_) break;
    }
    return at;
  }

  void RememberNearest(const PoseQuery& instance) {
    if (instance.choice.certain &&
        (!nearest_ || instance.bracket.upper < nearest_->bracket.upper)) {
      nearest_ = instance;
    }
  }

  bool Exhausted() {
    exhausted_ = exhausted_ || work_.exhausted();
    return work_.exhausted();
  }

  // Contact at the end belongs to the next segment's, even where it is not certain throughout.
  void QueryEnd(SegmentResult* times) {
    if (Exhausted()) return;
    const PoseQuery end = QueryAt(duration_, TimeDirection::kBackward);
    if (!end.touching()) return;
    witness_ = end.bracket.witness;
    const double from = Extend(duration_, TimeDirection::kBackward);
    times->contact_continuous = from <= times->contact_to;
    times->contact_to = duration_;
  }

  const ShapeMotion motion_;
  const double duration_;
  const double size_;
  WorkBudget& work_;
  bool nested_ = false;     // One may be inside the other.
  bool exhausted_ = false;  // Something was not looked at for want of work.
  std::optional<PoseQuery> last_forward_, last_backward_;
  std::optional<PoseQuery> nearest_;  // least upper bound of the distance
  std::optional<Approach> approach_;
  ContactWitness leaves_;   // that may touch first
  ContactWitness witness_;  // of contact, where it was last certain
};

// When, and the direction before; what is told of an instant is left.
ShapeSegmentResult EvaluateTimes(double duration, const SegmentResult& balls,
                                 SegmentEvaluation* evaluation, WorkBudget* work) {
  ShapeSegmentResult verdict;
  SegmentResult& times = verdict.times;
  if (balls.free_until == numeric::kInfinity || balls.free_from == -numeric::kInfinity) {
    times.free_until = numeric::kInfinity;
    times.free_from = -numeric::kInfinity;
    return verdict;
  }
  const double from = std::max(0.0, balls.free_until);
  times.free_until = [&] {
    const WorkShare share(kForwardShare, work);
    return evaluation->FreeFrom(from, TimeDirection::kForward);
  }();
  if (balls.free_until < 0 && times.free_until == from) times.free_until = balls.free_until;
  if (times.free_until == numeric::kInfinity) {
    times.free_from = -numeric::kInfinity;
    return verdict;
  }
  const double until = std::min(duration, balls.free_from);
  times.free_from = [&] {
    const WorkShare share(kBackwardShare, work);
    return evaluation->FreeFrom(until, TimeDirection::kBackward);
  }();
  if (times.free_from == -numeric::kInfinity) {  // the same from the other side
    times.free_until = numeric::kInfinity;
    return verdict;
  }
  if (times.free_from < times.free_until) {  // the two advances met
    times.free_until = numeric::kInfinity;
    times.free_from = -numeric::kInfinity;
    return verdict;
  }
  times.free_until = std::min(times.free_until, numeric::NextDown(duration));
  {
    const WorkShare share(kDirectionShare, work);
    verdict.normal = evaluation->Normal();
  }
  evaluation->FindContact(std::max(0.0, times.free_until), times.free_from, &times);
  evaluation->Sharpen(std::max(0.0, times.free_until), times.free_from, &times);
  evaluation->QueryOnce(std::max(0.0, times.free_until));
  return verdict;
}

}  // namespace

ShapeSegmentResult EvaluateShapeSegment(const BodySegment& a, const BodySegment& b, double duration,
                                        const SegmentResult& balls, WorkBudget* work) {
  SegmentEvaluation evaluation(a, b, duration, work);
  ShapeSegmentResult verdict = [&] {
    const WorkShare share(kTimesShare, work);
    return EvaluateTimes(duration, balls, &evaluation, work);
  }();
  verdict.exhausted = evaluation.exhausted();
  if (evaluation.nearest()) {
    verdict.looked = true;
    verdict.nearest_at = evaluation.nearest()->at;
    verdict.nearest = evaluation.NearestProximity();
    const bool contact = verdict.times.contact_from <= verdict.times.contact_to;
    if (!contact && evaluation.exhausted()) verdict.nearest.limited_by = EventLimit::kBudget;
  }
  return verdict;
}

double FreeAhead(const BodySegment& a, const BodySegment& b, double from, double duration,
                 WorkBudget* work) {
  return SegmentEvaluation(a, b, duration, work).FreeFrom(from, TimeDirection::kForward);
}

ContactNormal NormalAt(const BodySegment& a, const BodySegment& b, double delta, WorkBudget* work) {
  return NormalOf(ShapeMotion(a, b, work).QuerySeparation(delta, Goal::kNearest));
}

Proximity ShapeProximity(const BodySegment& a, const BodySegment& b, double delta,
                         WorkBudget* work) {
  const ShapeMotion motion(a, b, work);
  PoseQuery instance = motion.QuerySeparation(delta, Goal::kContact);
  motion.CheckContainment(&instance);
  return ProximityFrom(instance, motion, a.ball.radius + b.ball.radius);
}

}  // namespace collision::narrow_phase
