// Free, touching or undecided: two bodies of which at least one has a shape, over one segment of
// time.
#pragma once

#include "collision_core/narrow_phase/proximity.h"
#include "collision_core/narrow_phase/separation.h"

namespace collision {

/// A direction that is known better than this tells whom to bounce where [rad].
inline constexpr double kGoodNormal = 0.3;

/// The direction of the shortest way between two surfaces, shortly before they may touch.
struct ContactNormal {
  bool known = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< As in Proximity.
  double error = 0;

  /// Well enough; else an earlier instant is asked as well.
  bool tells() const { return known && error < kGoodNormal; }
};

struct ShapeVerdict {
  SegmentVerdict times;
  ContactNormal normal;    ///< Of the last instant before `times.free_until` that tells it well.
  bool exhausted = false;  ///< For want of work something was not looked at.
  /// Of the instants looked at, the one with the least upper bound of the distance.
  bool looked = false;
  double nearest_at = 0;
  Proximity nearest;
};

/// Judges [0, duration], inside of what the balls leave open (`balls`: the verdict on the two balls).
///
/// Conservative advancement: from a certified gap at one instant nothing touches before the gap is
/// used up by the greatest relative speed of any two points, the growth of the uncertainties
/// included; and from certain contact by a margin contact lasts until the margin is used up. So
/// contacts that begin and end within the segment are found, and freedom is certified for all of
/// it, not for samples. Requires that neither is awaited.
ShapeVerdict JudgeShapes(const BodySegment& a, const BodySegment& b, double duration,
                         const SegmentVerdict& balls, Work* work);

/// How far from `from` on the two stay apart for certain, up to `duration`; `from` itself if they may
/// touch at once. +infinity: throughout, the end included. Like the others below it requires that one
/// of the two has a shape and neither is awaited.
double FreeAhead(const BodySegment& a, const BodySegment& b, double from, double duration,
                 Work* work);

/// The direction of the shortest way between the two at δ, where they are apart.
ContactNormal NormalAt(const BodySegment& a, const BodySegment& b, double delta, Work* work);

/// At δ.
Proximity ShapeProximity(const BodySegment& a, const BodySegment& b, double delta, Work* work);

}  // namespace collision
