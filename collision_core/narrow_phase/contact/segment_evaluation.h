// The steps by which EvaluateShapeSegment() finds when two bodies are apart and when they touch.
#pragma once

#include <optional>

#include "collision_core/narrow_phase/contact/ball_contact.h"
#include "collision_core/narrow_phase/contact/contact_normal.h"
#include "collision_core/narrow_phase/contact/shape_motion.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::narrow_phase {

/// Two bodies over [0, duration], in seconds from the base of their segments. The steps are made in
/// the order of the functions below; each remembers what serves the later ones: the leaves that may
/// touch first, the last witness of contact, and the instant with the least distance.
class SegmentEvaluation {
 public:
  /// Everything passed in outlives this. Requires that neither body is awaited.
  SegmentEvaluation(const BodySegment& a, const BodySegment& b, double duration, WorkBudget* work)
      : motion_(a, b, work),
        duration_(duration),
        size_(a.ball.radius + b.ball.radius),
        work_(*work) {}

  /// How far from `at` on, towards the end or the start, the two certainly stay apart; ±infinity:
  /// throughout.
  double FreeFrom(double at, TimeDirection direction);

  /// Looks for certain contact in [free_until, free_from], which is not certified free.
  void FindContact(double free_until, double free_from, SegmentResult* times);

  /// Looks for an earlier begin and a later end of a contact that FindContact() found late, as it
  /// does if edges coincide.
  void Sharpen(double free_until, double free_from, SegmentResult* times);

  /// The normal shortly before the two may touch for the first time.
  ContactNormal Normal();

  /// Evaluates the instant `at` if none was evaluated before, whatever the budget.
  void QueryOnce(double at);

  /// The instant with the least upper bound of the distance, of those that were evaluated.
  const std::optional<ShapeMotion::PoseQuery>& nearest() const { return nearest_; }
  /// Requires nearest().
  Proximity NearestProximity();
  /// The budget ended something early.
  bool exhausted() const { return exhausted_; }

 private:
  using PoseQuery = ShapeMotion::PoseQuery;
  struct Approach {
    double from, to;  // apart in between
  };

  void SharpenEnd(double free, double until, TimeDirection direction, SegmentResult* times);
  void Remember(const ImpactBound& touch, double start, double at);
  bool FollowLeaves(double f, double g, SegmentResult* times);
  void TakeContact(double from, double place, double g, SegmentResult* times);
  bool TryContact(double f, double g, double place, SegmentResult* times);
  PoseQuery& QueryAt(double at, TimeDirection direction);
  double Extend(double at, TimeDirection direction);
  void RememberNearest(const PoseQuery& query);
  bool Exhausted();
  void QueryEnd(SegmentResult* times);

  const ShapeMotion motion_;
  const double duration_;
  const double size_;
  WorkBudget& work_;

  bool nested_ = false;     // One body may be inside the other.
  bool exhausted_ = false;  // The budget ended something early.
  std::optional<PoseQuery> last_forward_, last_backward_;
  std::optional<PoseQuery> nearest_;  // least upper bound of the distance
  std::optional<Approach> approach_;
  ContactWitness leaves_;   // that may touch first
  ContactWitness witness_;  // of contact, where it was last certain
};

}  // namespace collision::narrow_phase
