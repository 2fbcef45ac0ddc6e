#include "collision_core/narrow_phase/contact/segment_evaluation.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/contact/contact_boundary.h"
#include "collision_core/narrow_phase/contact/contact_proximity.h"

namespace collision::narrow_phase {
namespace {

// An advance ends where its steps are shorter than this share of the segment.
constexpr double kResolution = 1e-6;

// Contact that is certain for less than this share of the segment is followed no further.
constexpr double kShortestStep = 1e-10;

// The direction is taken where the gap is this many times what is uncertain, if there is such an
// instant: nearer it is not known, farther it is that of another time. DeviationOf() makes it 0.19
// rad.
constexpr double kDirectionGap = 128;

// At least so long before the first possible touch, as a share of the segment.
constexpr double kNormalBefore = 1e-3;

// An instant whose pose is so many times better known is preferred, though it is earlier.
constexpr double kMuchBetter = 16;

// Contact is searched from this share of the segment after the last certain freedom on, and when it
// is found between two queries, so often half-way between them.
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
// than this share of the segment, is searched again, by points near where the two touch first.
constexpr double kLate = 4;
constexpr double kLateShare = 1e-5;
constexpr double kFineShare = 1e-9;

}  // namespace

double SegmentEvaluation::FreeFrom(double at, TimeDirection direction) {
  ContactBoundary edge =
      ContactBoundary::Coarse(motion_, duration_, kResolution * duration_, direction, &work_);
  const double free = edge.FreeFrom(at);
  nested_ = nested_ || edge.nested();
  exhausted_ = exhausted_ || edge.exhausted();
  if (direction == TimeDirection::kForward && std::isfinite(free)) Remember(edge.touch(), at, free);
  return free;
}

void SegmentEvaluation::FindContact(double f, double g, SegmentResult* times) {
  if (FollowLeaves(f, g, times)) return;
  if (TryContact(f, g, f, times) || TryContact(f, g, g, times)) return;
  double width = g - f;
  for (int depth = 1; depth <= kSearchDepth; ++depth) {
    width /= 2;
    if (TryContact(f, g, f + width, times)) return;
    if (depth > 1 && TryContact(f, g, g - width, times)) return;
  }
}

void SegmentEvaluation::Sharpen(double f, double g, SegmentResult* times) {
  const bool found = times->contact_from <= times->contact_to;
  if (found ? times->contact_from > f : f > 0) {
    SharpenEnd(f, found ? times->contact_from : g, TimeDirection::kForward, times);
  }
  if (found && times->contact_to < g && g < duration_) {
    SharpenEnd(g, times->contact_to, TimeDirection::kBackward, times);
  }
}

ContactNormal SegmentEvaluation::Normal() {
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
  const double gap = kDirectionGap * end.uncertainty;
  const double back = std::max(kNormalBefore * duration_, gap / motion_.SpeedAt(end));
  const double before = std::max(approach_->from, approach_->to - back);
  const ContactNormal near = NormalOf(motion_.QuerySeparation(before, Goal::kNearest, leaves_));
  if (near.is_good() || before == approach_->from || work_.exhausted()) return near;
  const ContactNormal far =
      NormalOf(motion_.QuerySeparation(approach_->from, Goal::kNearest, leaves_));
  return far.known && (!near.known || far.error < near.error) ? far : near;
}

void SegmentEvaluation::QueryOnce(double at) {
  if (!nearest_) QueryAt(at, TimeDirection::kForward);
}

Proximity SegmentEvaluation::NearestProximity() {
  CORE_CHECK(nearest_, "an instant was evaluated");
  motion_.CheckContainment(&*nearest_);
  return ProximityFrom(*nearest_, motion_, size_);
}

void SegmentEvaluation::SharpenEnd(double free, double until, TimeDirection direction,
                                   SegmentResult* times) {
  if (std::abs(until - free) <= kLateShare * duration_ || Exhausted()) return;
  const PoseQuery query = motion_.RecheckWitness(free, {});
  if (!query.choice.certain) return;
  const double late = kLate * query.uncertainty / motion_.SpeedAt(query);
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

void SegmentEvaluation::Remember(const ImpactBound& touch, double start, double at) {
  if (touch.resolved) leaves_ = ContactWitness::Leaves(touch.leaves);
  if (at > start) approach_ = Approach{start, at};
}

// The leaves that may touch first are likely to: when do their triangles cross for certain? At f,
// where contact goes on from before; else at growing distances from it, then nearer by halves.
bool SegmentEvaluation::FollowLeaves(double f, double g, SegmentResult* times) {
  if (leaves_.is_none() || Exhausted()) return false;
  witness_ = {};
  const auto touches = [&](double place) {
    const PoseQuery query = motion_.RecheckWitness(place, leaves_);
    if (query.touching()) witness_ = query.bracket.witness;
    return query.touching();
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

// Records that contact is certain from `from` to `place`, and how much longer it lasts.
void SegmentEvaluation::TakeContact(double from, double place, double g, SegmentResult* times) {
  times->contact_from = from;
  times->contact_to = Extend(place, TimeDirection::kForward);
  if (times->contact_to < g && g >= duration_) QueryEnd(times);
}

// Tests whether contact is certain at `place`; if so, it is for some time before and after.
bool SegmentEvaluation::TryContact(double f, double g, double place, SegmentResult* times) {
  if (Exhausted()) return false;
  const TimeDirection side = place != f ? TimeDirection::kBackward : TimeDirection::kForward;
  const PoseQuery query = QueryAt(place, side);
  if (!query.touching()) return false;
  witness_ = query.bracket.witness;
  TakeContact(Extend(place, TimeDirection::kBackward), place, g, times);
  return true;
}

// Queries one instant. Both advances end where contact is searched first, so the last query from
// either side is kept.
ShapeMotion::PoseQuery& SegmentEvaluation::QueryAt(double at, TimeDirection direction) {
  const bool backward = direction == TimeDirection::kBackward;
  std::optional<PoseQuery>& last = backward ? last_backward_ : last_forward_;
  if (last && last->at == at) return *last;
  last = motion_.QuerySeparation(at, Goal::kDecision);
  if (nested_) motion_.CheckContainment(&*last);
  RememberNearest(*last);
  return *last;
}

// How far contact is certain from here on, without a gap. What makes it certain at one instant is
// tested again at the next; where that falls short another witness is searched.
double SegmentEvaluation::Extend(double at, TimeDirection direction) {
  const bool backward = direction == TimeDirection::kBackward;
  ContactWitness witness = witness_;
  double longest = 0;
  while (!Exhausted()) {
    PoseQuery query = motion_.RecheckWitness(at, witness);
    double lasts = query.touching() ? motion_.ContactStep(query, direction) : 0;
    if (lasts <= kFallenShort * longest || lasts == 0) {
      query = motion_.QuerySeparation(at, Goal::kContact);
      if (nested_) motion_.CheckContainment(&query);
      RememberNearest(query);
      if (!query.touching()) break;
      witness = query.bracket.witness;
      const double other = motion_.ContactStep(query, direction);
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

void SegmentEvaluation::RememberNearest(const PoseQuery& query) {
  if (query.choice.certain && (!nearest_ || query.bracket.upper < nearest_->bracket.upper)) {
    nearest_ = query;
  }
}

bool SegmentEvaluation::Exhausted() {
  exhausted_ = exhausted_ || work_.exhausted();
  return work_.exhausted();
}

// Contact at the end belongs to the next segment's, even where it is not certain throughout.
void SegmentEvaluation::QueryEnd(SegmentResult* times) {
  if (Exhausted()) return;
  const PoseQuery end = QueryAt(duration_, TimeDirection::kBackward);
  if (!end.touching()) return;
  witness_ = end.bracket.witness;
  const double from = Extend(duration_, TimeDirection::kBackward);
  times->contact_continuous = from <= times->contact_to;
  times->contact_to = duration_;
}

}  // namespace collision::narrow_phase
