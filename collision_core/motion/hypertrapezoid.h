// Hubbard's hypertrapezoid: a horn's box over a window, with flat faces.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision::motion {

/// The box of a horn over the window [start, start + duration], with flat faces: each of the six
/// faces of the box is replaced by the chord between its values at the two ends. Where no
/// acceleration is known, the faces of the horn's box are convex in time, so a chord never cuts
/// inside. A known acceleration that pulls a face inward bends it at most at that rate a: over a
/// window of T the face bulges out of its chord by at most ⅛ a T², by which both ends are moved
/// outward. Values are rounded outward; a face at time t is the mean of its two ends, weighted by
/// the exact fraction of the window. World frame W, metres. Source: Hubbard 1995
/// (space_time_bound.h), section 3.
struct Hypertrapezoid {
  Instant start;
  double duration = 0;                  ///< Length of the window [s], rounded down.
  double lower_start[3], lower_end[3];  ///< The three lower faces at the window's two ends [m].
  double upper_start[3], upper_end[3];
};

/// The hypertrapezoid of a bound. If the declared direction ends inside the window, the full ball
/// counts. Requires state.stamp <= start <= end.
Hypertrapezoid MakeHypertrapezoid(const SpaceTimeBound& bound, Instant start, Instant end);

/// Seconds after the start when two hypertrapezoids first overlap, rounded down: 0 if they overlap
/// there, +infinity if they do not overlap within the window. They overlap during one interval at
/// most: from the latest of the three per-axis entries to the earliest of the three exits. Requires
/// the same window for both.
double FirstOverlap(const Hypertrapezoid& a, const Hypertrapezoid& b);

}  // namespace collision::motion
