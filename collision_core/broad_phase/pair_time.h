// The canonical answer: when two agents can first meet.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// Seconds after a base instant, rounded down; +infinity: never.
struct PairTime {
  Instant base;
  double seconds;

  /// Rounded down to the nanosecond.
  Instant instant() const { return AddRoundedDown(base, seconds); }
};

/// The earliest possible intersection of A and B at or after base = max(from, stamp_A, stamp_B):
/// the latest of the first overlap of the two balls, of the two boxes and, where a speed cap is
/// declared, of the capped balls (speed_cap.h). Never late: no motion that honours both declarations
/// touches in [base, base + seconds). Not idle: early by at most max(1e-9 · seconds, what the
/// inputs' rounding forces). The boxes are asked only where a direction or a cap is declared;
/// elsewhere they contain the balls. Agents that cannot meet (masks), or one of which has expired by
/// base, meet never; after an expiry likewise. Two that never move never meet, even where they
/// overlap. Symmetric: (A, B) and (B, A) give the same bits.
PairTime EarliestIntersection(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant from);

/// The same bits where the answer's instant is not later than `until`, else never: it can stop
/// looking there. With a `margin` [m], finite and >= 0, two meet where they come within it of each
/// other: both radii together are larger by as much, exactly, in all that has been said.
PairTime EarliestIntersection(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant from,
                              Instant until, double margin = 0);

}  // namespace collision
