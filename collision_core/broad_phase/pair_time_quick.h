// A pair of horns, in plain doubles for the quick root finder.
#pragma once

#include "collision_core/broad_phase/first_approach_quick.h"
#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// The balls of the two forward horns, their radii together larger by `margin`, with time counted
/// from `base`, not before either stamp: what rounding may cost is added to the reach. Symmetric: (A, B) and (B, A) give the same bits, or the
/// negated ones. All reaches are infinite, and so decide nothing, if a difference of times overflows.
QuickApproach QuickPair(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant base,
                        double margin = 0);

}  // namespace collision
