// The onset or the end of a contact: how long two bodies stay apart, and how soon they certainly
// touch.
#pragma once

#include <optional>

#include "collision_core/narrow_phase/contact/contact_tolerance.h"
#include "collision_core/narrow_phase/contact/shape_motion.h"

namespace collision::narrow_phase {

/// Advances through a segment of time from one of its ends towards the other: forward it finds the
/// onset of a contact, backward its end. Everything passed in outlives it.
class ContactBoundary {
 public:
  /// For time brackets as narrow as `tolerance` asks for.
  ContactBoundary(const ShapeMotion& motion, double duration, const ContactTolerance& tolerance,
                  TimeDirection direction, WorkBudget* work)
      : ContactBoundary(motion, duration, direction, Precision{tolerance, false}, work) {}
  /// For a service that has many pairs to evaluate: FreeFrom() ends where a step is shorter than
  /// `shortest_step` [s], or where the uncertainty of the motion leaves little for another sweep.
  static ContactBoundary Coarse(const ShapeMotion& motion, double duration, double shortest_step,
                                TimeDirection direction, WorkBudget* work) {
    return {motion, duration, direction, Precision{{shortest_step, 0}, true}, work};
  }

  /// Returns the instant up to which the two are certainly apart, beginning at `at`; ±infinity: all
  /// the way, the end of the segment included.
  double FreeFrom(double at);

  /// Returns an instant of certain contact as soon as possible after `free`, the result of
  /// FreeFrom(), and not beyond `until`; none if no contact is certain.
  std::optional<double> ContactAfter(double free, double until);

  /// As ContactAfter(), but by contact candidates only: for a contact that is already certain at
  /// `until` by other means, or not certain at all.
  std::optional<double> ContactByCandidates(double free, double until);

  /// Returns how far, from `touching` towards `until`, contact is certain without a gap by the
  /// candidate that showed it.
  double LastsFrom(double touching, double until) const;

  /// Whether one body may be inside the other: then no instant is certified free.
  bool nested() const { return nested_; }
  /// The sweep that ended the last FreeFrom().
  const ImpactBound& touch() const { return touch_; }
  /// Whether the budget ended a step early.
  bool exhausted() const { return exhausted_; }
  /// The bodies certainly come as near as this [m].
  double nearest() const { return nearest_; }
  /// Whether the pose from which ContactAfter() or ContactByCandidates() last searched is uncertain
  /// by more than rounding; false before.
  bool uncertain() const { return uncertain_; }
  /// Whether the orientation of a body was unknown where the last sweep of FreeFrom() began; more
  /// work does not help then.
  bool orientation_unknown() const { return orientation_unknown_; }

 private:
  struct Precision {
    ContactTolerance tolerance;
    bool coarse;
  };
  // What is tested for contact at an instant: the parts that may touch first, or the whole bodies.
  enum class Scope { kLikely, kEverything };

  ContactBoundary(const ShapeMotion& motion, double duration, TimeDirection direction,
                  const Precision& precision, WorkBudget* work)
      : motion_(motion),
        duration_(duration),
        tolerance_(precision.tolerance),
        direction_(direction),
        coarse_(precision.coarse),
        detail_(precision.coarse ? SweepDetail{} : kFineDetail),
        work_(*work) {}

  // A sweep refines nearly down to the uncertainty of the motion, as far as tangents serve.
  static constexpr SweepDetail kFineDetail{.fine_enough = 0.03125, .step_worth = 1e-6};

  // When SweptRingBound() is evaluated next: after `wait` sweeps; what it had cost until then.
  struct Turns {
    int sweeps = 0, wait = 1;
    std::uint64_t spent = 0;
  };

  bool is_backward() const { return direction_ == TimeDirection::kBackward; }
  double RingFreedomFrom(double at, double left, double span, Turns* turns) const;
  double Moved(double at, double seconds) const;
  double ToleranceAt(double at) const;
  double StallAt(double at) const;
  bool Exhausted();
  bool Touches(double at, Scope scope);
  bool TouchesByCandidates(double at);
  bool Record(const ShapeMotion::PoseQuery& query);
  double Narrow(double apart, double touching, double free, Scope scope);
  void Prepare(double free);
  double FirstStep(double free, double until) const;
  double Towards(double until, double from, double step) const;
  std::optional<double> QuickContact(double free, double until);
  std::optional<double> ThoroughContact(double free, double until);

  const ShapeMotion& motion_;
  const double duration_;
  const ContactTolerance tolerance_;
  const TimeDirection direction_;
  const bool coarse_;
  const SweepDetail detail_;
  WorkBudget& work_;

  bool nested_ = false;     // One body may be inside the other.
  bool exhausted_ = false;  // The budget ended something early.
  bool apart_ = false;      // At the last instant at which the whole bodies were tested.
  bool uncertain_ = false;
  bool orientation_unknown_ = false;
  double nearest_ = numeric::kInfinity;
  ImpactBound touch_;
  std::vector<ContactCandidate> candidates_;
  ContactWitness witness_;
};

}  // namespace collision::narrow_phase
