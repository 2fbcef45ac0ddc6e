// Hubbard's hypertrapezoid: a horn's box over a window, with flat faces.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// Over [start, end] each face of the horn's box is replaced by the chord between its two ends. The
/// faces are convex in t, so no chord cuts inside. Values are rounded outward; a face at t is the
/// mean of its two ends, weighted by the exact fraction of the window. Source: Hubbard 1995,
/// section 3.
struct Hypertrapezoid {
  Instant start;
  double duration = 0;                  ///< Of the window [s], rounded down.
  double lower_start[3], lower_end[3];  ///< The three lower faces at the window's two ends [m].
  double upper_start[3], upper_end[3];
};

/// Requires stamp <= start <= end. Where the declared direction ends inside the window, the full
/// ball counts.
Hypertrapezoid MakeHypertrapezoid(const SpaceTimeBound& bound, Instant start, Instant end);

/// Seconds after the (shared) start when two hypertrapezoids first overlap, rounded down; 0 if they
/// overlap there; +infinity if not within the window.
double FirstOverlap(const Hypertrapezoid& a, const Hypertrapezoid& b);

/// One hypertrapezoid that contains both (same window).
Hypertrapezoid Unite(const Hypertrapezoid& a, const Hypertrapezoid& b);

}  // namespace collision
