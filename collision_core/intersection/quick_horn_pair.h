// A pair of horns, in plain doubles for the quick root finder.
#pragma once

#include "collision_core/intersection/bound_pair.h"
#include "collision_core/numeric/first_approach_quick.h"

namespace collision::intersection {

/// The relative motion of two forward horns as an exact problem in doubles, with the sum of the
/// radii larger by the pair's margin. What rounding may have cost is added to the reach: 6 · 2^-53
/// of the magnitudes of the centre's terms, 2 · 2^-53 of the velocity's, and 20 · 2^-53 of each
/// coefficient of the reach itself; 12, 8 and 28 where an acceleration is known or a jerk declared.
/// Symmetric: (A, B) and (B, A) give the same bits, or the negated
/// ones. If a difference of times overflows, all reaches are infinite and so decide nothing.
numeric::QuickApproach QuickHornPair(const BoundPair& pair);

}  // namespace collision::intersection
