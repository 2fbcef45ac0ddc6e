// How fast a gap between two bodies can be used up.
#pragma once

#include "collision_core/narrow_phase/separation.h"

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
  };

  Instance LookAt(double at, Goal goal) const;

  /// Where the surfaces are apart: so are the solids.
  bool NeitherInside(const Instance& instance) const;

  /// Seconds for which the two stay apart from `instance` on, towards later or earlier times;
  /// +infinity: for ever. Requires apart().
  double FreeStep(const Instance& instance, bool backward) const;

  /// Likewise for contact. Requires touching().
  double ContactStep(const Instance& instance, bool backward) const;

 private:
  struct Drift;
  Drift DriftFrom(const Instance& instance, bool backward) const;

  const BodySegment& a_;
  const BodySegment& b_;
  const Surface surface_a_;
  const Surface surface_b_;
  Work& work_;
};

}  // namespace collision
