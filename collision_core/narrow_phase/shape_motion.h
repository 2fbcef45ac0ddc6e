// How fast a gap between two bodies can be used up.
#pragma once

#include "collision_core/narrow_phase/contact_patch.h"
#include "collision_core/narrow_phase/swept_pair.h"

namespace collision {

/// Two bodies over a segment: looks at instants of it, and steps of conservative advancement between
/// them.
class ShapeMotion {
 public:
  /// Everything passed in outlives this.
  ShapeMotion(const BodySegment& a, const BodySegment& b, Work* work);

  struct Instance {
    double at = 0;
    BoundChoice choice;
    RelativePose pose;
    Look look;

    /// The surfaces are apart for all motions within the bounds. Says nothing of the inside.
    bool apart() const { return choice.certain && look.lower > pose.translation; }
    bool touching() const {
      return choice.certain &&
             (look.upper <= -pose.translation || look.crossing_margin >= pose.translation / 2);
    }
    /// How far one body may be off relative to the other, all in all.
    double uncertainty = 0;
    /// Neither is inside the other, as LookInside() found where the surfaces are apart.
    bool neither_inside = false;
  };

  Instance LookAt(double at, Goal goal, const Evidence& hint = {}) const;

  /// Nothing but what made contact certain at another instant.
  Instance LookAgain(double at, const Evidence& evidence) const;

  /// Nothing but this.
  Instance LookAt(double at, const ContactClue& clue) const;

  /// Where the two are likely to overlap soon, at an instant at which they nearly touch.
  std::vector<ContactClue> PatchAt(double at, const FirstTouch& touch) const;

  /// How soon the two may touch from an instant on, towards later or earlier times, within `span`
  /// seconds; `known` is false where nothing is known of one of them.
  struct Sweep {
    bool known = false;
    RelativePose pose;  ///< At its start.
    FirstTouch touch;
    /// The search went down to what is known of the motion: another one from there leads no further.
    bool final = false;
  };
  Sweep SweepFrom(double at, double span, bool backward, const SweepDetail& detail = {}) const;

  /// Over so many of the `left` seconds one sweep is worth its while: beyond, tangents leave their
  /// curves and other bounds may be the narrower ones.
  double SpanFrom(double at, double left, bool backward, double duration) const;

  /// How long from `at` on they stay apart however far each has turned by then, of the `left`
  /// seconds; 0 where neither turns much. +infinity: all of it, the end included. So that the work
  /// does not grow with turns that matter nothing. Says nothing of the inside. Spends `units` about.
  double RevolvedFree(double at, double left, bool backward, double duration,
                      std::uint64_t units) const;

  /// Where the surfaces are apart: so are the solids.
  bool NeitherInside(const RelativePose& pose) const;

  /// Where a look found the surfaces apart: one solid inside the other is contact, as deep as they
  /// are apart, since no shorter way takes it out again.
  void LookInside(Instance* instance) const;

  /// No shift longer than this is needed to take the two apart at an instant, whatever the motion
  /// within the bounds [m].
  double DepthAtMost(const Instance& instance) const;

  /// Seconds for which contact lasts from `instance` on, towards later or earlier times; +infinity:
  /// for ever. Requires touching().
  double ContactStep(const Instance& instance, bool backward) const;

  double size() const { return surface_a_.reach() + surface_b_.reach(); }

  /// No two points of the bodies move faster relative to each other, as predicted [m/s].
  double SpeedAt(const Instance& instance) const;

 private:
  struct Drift;
  Instance InstanceAt(double at) const;
  Drift DriftFrom(const Instance& instance, bool backward) const;
  BoundChoice ChoiceFor(double at, double span, bool backward) const;
  SweptPose SweptFrom(double at, BoundChoice choice, bool backward, bool bends) const;
  double ToMiddle(double at, double left, bool backward, double duration) const;
  double FastestTurn() const;

  const BodySegment& a_;
  const BodySegment& b_;
  const Surface surface_a_;
  const Surface surface_b_;
  Work& work_;
};

}  // namespace collision
