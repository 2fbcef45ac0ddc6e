#include "collision_core/narrow_phase/contact/shape_contact.h"

#include <algorithm>

#include "collision_core/narrow_phase/contact/contact_proximity.h"
#include "collision_core/narrow_phase/contact/segment_evaluation.h"

namespace collision::narrow_phase {
namespace {

using PoseQuery = ShapeMotion::PoseQuery;

// Shares of the work that is left: for all times, so that something remains for the depth; within
// it for how long the two are free from the start, then from the end, then for the direction in
// which they approach; the rest is for contact.
constexpr double kTimesShare = 0.9;
constexpr double kForwardShare = 0.4;
constexpr double kBackwardShare = 0.3;
constexpr double kDirectionShare = 0.6;

// The times of freedom and contact, and the normal before; the caller adds the proximity.
ShapeSegmentResult EvaluateTimes(double duration, const SegmentResult& balls,
                                 SegmentEvaluation* evaluation, WorkBudget* work) {
  ShapeSegmentResult result;
  SegmentResult& times = result.times;
  if (balls.free_until == numeric::kInfinity || balls.free_from == -numeric::kInfinity) {
    times.free_until = numeric::kInfinity;
    times.free_from = -numeric::kInfinity;
    return result;
  }
  const double from = std::max(0.0, balls.free_until);
  times.free_until = [&] {
    const WorkShare share(kForwardShare, work);
    return evaluation->FreeFrom(from, TimeDirection::kForward);
  }();
  if (balls.free_until < 0 && times.free_until == from) times.free_until = balls.free_until;
  if (times.free_until == numeric::kInfinity) {
    times.free_from = -numeric::kInfinity;
    return result;
  }
  const double until = std::min(duration, balls.free_from);
  times.free_from = [&] {
    const WorkShare share(kBackwardShare, work);
    return evaluation->FreeFrom(until, TimeDirection::kBackward);
  }();
  if (times.free_from == -numeric::kInfinity) {  // the same from the other side
    times.free_until = numeric::kInfinity;
    return result;
  }
  if (times.free_from < times.free_until) {  // the two advances met
    times.free_until = numeric::kInfinity;
    times.free_from = -numeric::kInfinity;
    return result;
  }
  times.free_until = std::min(times.free_until, numeric::NextDown(duration));
  {
    const WorkShare share(kDirectionShare, work);
    result.normal = evaluation->Normal();
  }
  evaluation->FindContact(std::max(0.0, times.free_until), times.free_from, &times);
  evaluation->Sharpen(std::max(0.0, times.free_until), times.free_from, &times);
  evaluation->QueryOnce(std::max(0.0, times.free_until));
  return result;
}

}  // namespace

ShapeSegmentResult EvaluateShapeSegment(const BodySegment& a, const BodySegment& b, double duration,
                                        const SegmentResult& balls, WorkBudget* work) {
  SegmentEvaluation evaluation(a, b, duration, work);
  ShapeSegmentResult result = [&] {
    const WorkShare share(kTimesShare, work);
    return EvaluateTimes(duration, balls, &evaluation, work);
  }();
  result.exhausted = evaluation.exhausted();
  if (evaluation.nearest()) {
    result.examined = true;
    result.nearest_at = evaluation.nearest()->at;
    result.nearest = evaluation.NearestProximity();
    const bool contact = result.times.contact_from <= result.times.contact_to;
    if (!contact && evaluation.exhausted()) result.nearest.limited_by = BracketLimit::kBudget;
  }
  return result;
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
  PoseQuery query = motion.QuerySeparation(delta, Goal::kContact);
  motion.CheckContainment(&query);
  return ProximityFrom(query, motion, a.ball.radius + b.ball.radius);
}

}  // namespace collision::narrow_phase
