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
  /// Everything passed in outlives this. Requires that neither body is awaited.
  ShapeMotion(const BodySegment& a, const BodySegment& b, WorkBudget* work);

  /// Where a sweep begins, and in which direction of time it goes. Defined in the source.
  struct Departure;

  /// What is found at one pose of the two bodies.
  struct PoseQuery {
    double at = 0;
    BoundChoice choice;
    RelativePose pose;
    SeparationBracket bracket;

    /// The surfaces are apart for all motions within the bounds. Says nothing of the inside.
    bool apart() const { return choice.certain && bracket.CertainlyApart(pose.translation); }
    bool touching() const { return choice.certain && bracket.CertainlyTouching(pose.translation); }
    /// By how much a point of one body may be displaced relative to the other, all in all [m].
    double uncertainty = 0;
    /// Neither is inside the other, as CheckContainment() found where the surfaces are apart.
    bool neither_inside = false;
  };

  PoseQuery QuerySeparation(double at, Goal goal, const ContactWitness& hint = {}) const;

  /// Re-tests this witness of contact only.
  PoseQuery RecheckWitness(double at, const ContactWitness& witness) const;

  /// Evaluates this candidate only.
  PoseQuery QuerySeparation(double at, const ContactCandidate& candidate) const;

  /// Candidates for the first overlap, at an instant at which the two nearly touch.
  std::vector<ContactCandidate> CandidatesAt(double at, const ImpactBound& touch) const;

  /// How soon the two may touch from an instant on, towards later or earlier times, within `span`
  /// seconds; `known` is false if nothing is known of one of them.
  struct Sweep {
    bool known = false;
    RelativePose pose;  ///< At its start.
    ImpactBound touch;
    /// The search went down to the uncertainty of the motion: another one from there leads no
    /// further.
    bool final = false;
  };
  Sweep SweepFrom(double at, double span, TimeDirection direction,
                  const SweepDetail& detail = {}) const;

  /// For how many of the `left` seconds one sweep is worthwhile: later, tangents leave their curves
  /// and other bounds may be narrower.
  double SpanFrom(double at, double left, TimeDirection direction, double duration) const;

  /// How many of the `left` seconds from `at` on the surfaces stay apart by SweptRingBound(), which
  /// holds however far each body turns; 0 if neither turns much; +infinity: all of them, the end
  /// included. The work does not grow with turns that do not matter. Does not test containment.
  /// Spends about `units`.
  double RingFreedom(double at, double left, TimeDirection direction, double duration,
                     std::uint64_t units) const;

  /// Whether certainly neither body is inside the other. Unchecked: the surfaces are apart.
  bool NeitherInside(const RelativePose& pose) const;

  /// Tests containment if the query found the surfaces apart: one solid inside the other is
  /// contact, as deep as the surfaces are apart, because no shorter way takes it out again.
  void CheckContainment(PoseQuery* query) const;

  /// An upper bound of the penetration depth at an instant, for all motions within the bounds [m].
  double DepthAtMost(const PoseQuery& query) const;

  /// For how many seconds contact certainly lasts from `query` on, towards later or earlier
  /// times; +infinity: for ever. Requires touching().
  double ContactStep(const PoseQuery& query, TimeDirection direction) const;

  /// Whether the body has triangles or solids, and is no ball.
  bool HasElementsA() const { return a_.shape != nullptr; }
  bool HasElementsB() const { return b_.shape != nullptr; }

  double size() const { return surface_a_.reach() + surface_b_.reach(); }

  /// A lower bound of the distance of the surfaces throughout [from, to], which contains the
  /// instant of `query`; -infinity where it does not follow that they stay apart. Requires
  /// CheckContainment().
  double DistanceOver(const PoseQuery& query, double from, double to) const;

  /// An upper bound of the relative speed of any two points of the bodies, as predicted [m/s].
  double SpeedAt(const PoseQuery& query) const;

 private:
  struct Drift;
  PoseQuery PoseQueryAt(double at) const;
  Drift DriftFrom(const PoseQuery& query, TimeDirection direction) const;
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
