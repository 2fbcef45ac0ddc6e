// Queries, sweeps and steps through time for two bodies over a segment.
#pragma once

#include "collision_core/narrow_phase/advancement/conservative_advancement.h"
#include "collision_core/narrow_phase/contact/contact_candidates.h"
#include "collision_core/narrow_phase/pose/segment_pose.h"
#include "collision_core/narrow_phase/pose/time_direction.h"
#include "collision_core/narrow_phase/separation/separation_bracket.h"

namespace collision::narrow_phase {

/// A motion counts as exact if less than this share of the bodies' size is unknown of it: rounding
/// makes no more of an exact motion, some hundred units of 2^-53.
inline constexpr double kExactMotion = 1e-12;

/// Two bodies over a segment of time: separation queries at instants of it, and steps of
/// conservative advancement between them. Seconds count from the base of the segments.
class ShapeMotion {
 public:
  /// Everything passed in outlives this.
  ShapeMotion(const BodySegment& a, const BodySegment& b, WorkBudget* work);

  /// Where and in which direction a sweep begins; of this class and its source.
  struct Departure;

  struct PoseQuery {
    double at = 0;
    BoundChoice choice;
    RelativePose pose;
    SeparationBracket look;

    /// The surfaces are apart for all motions within the bounds. Says nothing of the inside.
    bool apart() const { return choice.certain && look.CertainlyApart(pose.translation); }
    bool touching() const { return choice.certain && look.CertainlyTouching(pose.translation); }
    /// How far one body may be off relative to the other, all in all.
    double uncertainty = 0;
    /// Neither is inside the other, as LookInside() found where the surfaces are apart.
    bool neither_inside = false;
  };

  PoseQuery QuerySeparation(double at, Goal goal, const ContactWitness& hint = {}) const;

  /// Re-tests this witness of contact only.
  PoseQuery RecheckWitness(double at, const ContactWitness& evidence) const;

  /// Evaluates this candidate only.
  PoseQuery QuerySeparation(double at, const ContactCandidate& clue) const;

  /// Where the two are likely to overlap soon, at an instant at which they nearly touch.
  std::vector<ContactCandidate> PatchAt(double at, const ImpactBound& touch) const;

  /// How soon the two may touch from an instant on, towards later or earlier times, within `span`
  /// seconds; `known` is false where nothing is known of one of them.
  struct Sweep {
    bool known = false;
    RelativePose pose;  ///< At its start.
    ImpactBound touch;
    /// The search went down to what is known of the motion: another one from there leads no
    /// further.
    bool final = false;
  };
  Sweep SweepFrom(double at, double span, TimeDirection direction,
                  const SweepDetail& detail = {}) const;

  /// Over so many of the `left` seconds one sweep is worth its while: beyond, tangents leave their
  /// curves and other bounds may be the narrower ones.
  double SpanFrom(double at, double left, TimeDirection direction, double duration) const;

  /// How long from `at` on they stay apart however far each has turned by then, of the `left`
  /// seconds; 0 where neither turns much. +infinity: all of it, the end included. So that the work
  /// does not grow with turns that matter nothing. Says nothing of the inside. Spends `units`
  /// about.
  double RevolvedFree(double at, double left, TimeDirection direction, double duration,
                      std::uint64_t units) const;

  /// Where the surfaces are apart: so are the solids.
  bool NeitherInside(const RelativePose& pose) const;

  /// Where a look found the surfaces apart: one solid inside the other is contact, as deep as they
  /// are apart, since no shorter way takes it out again.
  void LookInside(PoseQuery* instance) const;

  /// No shift longer than this is needed to take the two apart at an instant, whatever the motion
  /// within the bounds [m].
  double DepthAtMost(const PoseQuery& instance) const;

  /// Seconds for which contact lasts from `instance` on, towards later or earlier times; +infinity:
  /// for ever. Requires touching().
  double ContactStep(const PoseQuery& instance, TimeDirection direction) const;

  double size() const { return surface_a_.reach() + surface_b_.reach(); }

  /// No two points of the bodies move faster relative to each other, as predicted [m/s].
  double SpeedAt(const PoseQuery& instance) const;

 private:
  struct Drift;
  PoseQuery InstanceAt(double at) const;
  Drift DriftFrom(const PoseQuery& instance, TimeDirection direction) const;
  BoundChoice ChoiceFor(double at, double span, TimeDirection direction) const;
  SweptPose SweptFrom(const Departure& from, BoundChoice choice) const;
  double ToMiddle(double at, double left, TimeDirection direction, double duration) const;
  double FastestTurn() const;

  const BodySegment& a_;
  const BodySegment& b_;
  const BodyTree surface_a_;
  const BodyTree surface_b_;
  WorkBudget& work_;
};

}  // namespace collision::narrow_phase
