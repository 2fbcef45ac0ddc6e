// The onset or the end of a contact: how long two bodies stay apart, and how soon they certainly
// touch.
#pragma once

#include <optional>

#include "collision_core/narrow_phase/contact/shape_motion.h"
#include "collision_core/narrow_phase/contact/time_of_contact.h"

namespace collision::narrow_phase {

/// Finds one end of a contact: advances through a segment of time from its begin, or `backward`
/// from its end. First freedom is certified as far as possible (FreeFrom), then the first certain
/// contact after it is searched (ContactAfter): the two instants are the bracket. Everything passed
/// in outlives it.
class ContactBoundary {
 public:
  /// Searches brackets as narrow as `tolerance` asks for.
  ContactBoundary(const ShapeMotion& motion, double duration, const ContactTolerance& tolerance,
                  bool backward, WorkBudget* work)
      : ContactBoundary(motion, duration, tolerance, backward, false, work) {}

  /// For a service that judges many pairs: freedom ends where a step is shorter than
  /// `shortest_step` [s], or where another sweep would hardly reduce what is not known of the
  /// motion.
  static ContactBoundary Coarse(const ShapeMotion& motion, double duration, double shortest_step,
                                bool backward, WorkBudget* work) {
    return {motion, duration, {shortest_step, 0}, backward, true, work};
  }

  /// The two are apart from `at` up to the instant that is returned; ±infinity: up to the end of
  /// the segment, which is included.
  double FreeFrom(double at);

  /// An instant of certain contact as soon as possible after `free`, where freedom ends, and not
  /// beyond `until`.
  std::optional<double> ContactAfter(double free, double until);

  /// The same by candidate points alone, where another way showed contact at `until`, or none did.
  std::optional<double> ContactByClues(double free, double until);

  /// Up to when contact is certain without a gap from `touching` on, towards `until`, by the same
  /// point.
  double LastsFrom(double touching, double until) const;

  bool nested() const { return nested_; }  ///< One may be inside the other: nothing was free.
  const ImpactBound& touch() const { return touch_; }  ///< What ended the last freedom.
  bool exhausted() const { return exhausted_; }        ///< The work ended too early.
  double nearest() const { return nearest_; }          ///< They certainly come as near as this [m].
  bool uncertain() const { return uncertain_; }  ///< By more than rounding, where freedom ended.
  /// The orientation of one of them was unknown there: more work does not help.
  bool any_way() const { return any_way_; }

 private:
  ContactBoundary(const ShapeMotion& motion, double duration, const ContactTolerance& tolerance,
                  bool backward, bool coarse, WorkBudget* work)
      : motion_(motion),
        duration_(duration),
        tolerance_(tolerance),
        backward_(backward),
        coarse_(coarse),
        detail_(coarse ? SweepDetail{} : kFineDetail),
        work_(*work) {}

  // A sweep refines nearly down to the uncertainty of the motion, as far as tangents are valid.
  static constexpr SweepDetail kFineDetail{.fine_enough = 0.03125, .step_worth = 1e-6};

  // How often revolved bodies were queried (revolved_pair.h).
  struct Turns {
    int sweeps = 0, wait = 1;
    std::uint64_t spent = 0;
  };

  double RevolvedFrom(double at, double left, double span, Turns* turns) const;
  double Moved(double at, double seconds) const;
  double ToleranceAt(double at) const;
  double StallAt(double at) const;
  bool Exhausted();
  bool Touches(double at, bool thoroughly);
  bool TouchesByClues(double at);
  bool Note(const ShapeMotion::PoseQuery& instance);
  double Narrow(double apart, double touching, double free, bool thoroughly);
  void Prepare(double free);
  double FirstStep(double free, double until) const;
  double Towards(double until, double from, double step) const;
  std::optional<double> QuickContact(double free, double until);
  std::optional<double> ThoroughContact(double free, double until);

  const ShapeMotion& motion_;
  const double duration_;
  const ContactTolerance tolerance_;
  const bool backward_;
  const bool coarse_;
  const SweepDetail detail_;
  WorkBudget& work_;

  bool nested_ = false;     // One may be inside the other.
  bool exhausted_ = false;  // The work ended before everything was examined.
  bool apart_ = false;      // At the last instant that was examined thoroughly.
  bool uncertain_ = false;
  bool any_way_ = false;
  double nearest_ = numeric::kInfinity;
  ImpactBound touch_;
  std::vector<ContactCandidate> clues_;
  ContactWitness evidence_;
};

}  // namespace collision::narrow_phase
