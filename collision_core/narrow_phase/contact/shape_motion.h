// Queries, sweeps and steps through time for two bodies over a segment.
#pragma once

#include "collision_core/narrow_phase/advancement/conservative_advancement.h"
#include "collision_core/narrow_phase/contact/contact_candidates.h"

namespace collision::narrow_phase {

/// Two bodies over a segment of time: separation queries at instants of it, and steps of
/// conservative advancement between them. Seconds count from the base of the segments.
class ShapeMotion {
 public:
  /// Everything passed in outlives this.
  ShapeMotion(const BodySegment& a, const BodySegment& b, WorkBudget* work);

  /// What a query found at one instant: the pose, its uncertainty, and the bracket.
  struct PoseQuery {
    double at = 0;
    BoundChoice choice;
    RelativePose pose;
    SeparationBracket look;

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

  PoseQuery QuerySeparation(double at, Goal goal, const ContactWitness& hint = {}) const;

  /// Re-tests this witness of contact only.
  PoseQuery RecheckWitness(double at, const ContactWitness& evidence) const;

  /// Evaluates this candidate only.
  PoseQuery QuerySeparation(double at, const ContactCandidate& clue) const;

  /// Candidates for an overlap soon after `at`, an instant at which the two nearly touch.
  std::vector<ContactCandidate> PatchAt(double at, const ImpactBound& touch) const;

  /// How soon the two may touch from an instant on, towards later or earlier times, within `span`
  /// seconds; `known` is false where nothing is known of one of them.
  struct Sweep {
    bool known = false;
    RelativePose pose;  ///< At its start.
    ImpactBound touch;
    /// The search reached the uncertainty of the motion: another one from there leads no further.
    bool final = false;
  };
  Sweep SweepFrom(double at, double span, bool backward, const SweepDetail& detail = {}) const;

  /// How many of the `left` seconds one sweep should cover: beyond, tangents leave their curves,
  /// and other bounds may be narrower.
  double SpanFrom(double at, double left, bool backward, double duration) const;

  /// How many of the `left` seconds from `at` on the surfaces stay apart however far each body has
  /// turned by then (revolved_pair.h), so that the work does not grow with turns that do not
  /// matter. 0 if neither turns much; +infinity: all of them, the end included. Does not consider
  /// one body inside the other. Spends about `units`.
  double RevolvedFree(double at, double left, bool backward, double duration,
                      std::uint64_t units) const;

  /// Whether the solids are apart as well. Requires that the surfaces are apart.
  bool NeitherInside(const RelativePose& pose) const;

  /// Tests whether one solid is inside the other. Requires that a query found the surfaces apart.
  /// One inside the other is contact, as deep as the surfaces are apart, because no shorter shift
  /// takes it out again.
  void LookInside(PoseQuery* instance) const;

  /// An upper bound on the penetration depth at an instant, for every motion within the bounds [m].
  double DepthAtMost(const PoseQuery& instance) const;

  /// Seconds for which contact lasts from `instance` on, towards later or earlier times; +infinity:
  /// for ever. Requires touching().
  double ContactStep(const PoseQuery& instance, bool backward) const;

  double size() const { return surface_a_.reach() + surface_b_.reach(); }

  /// An upper bound on the relative speed of any two points of the bodies, as predicted [m/s].
  double SpeedAt(const PoseQuery& instance) const;

 private:
  struct Drift;
  PoseQuery InstanceAt(double at) const;
  Drift DriftFrom(const PoseQuery& instance, bool backward) const;
  BoundChoice ChoiceFor(double at, double span, bool backward) const;
  SweptPose SweptFrom(double at, BoundChoice choice, bool backward, bool bends) const;
  double ToMiddle(double at, double left, bool backward, double duration) const;
  double FastestTurn() const;

  const BodySegment& a_;
  const BodySegment& b_;
  const BodyTree surface_a_;
  const BodyTree surface_b_;
  WorkBudget& work_;
};

}  // namespace collision::narrow_phase
