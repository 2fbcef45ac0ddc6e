// A first test of what directions and speed caps change, in plain doubles.
#pragma once

#include "collision_core/intersection/bound_pair.h"

namespace collision::intersection {

/// Whether the capped balls and the boxes of a pair meet too, `time` seconds after its base, when
/// the balls of the horns do. The answer may be wrong by rounding, which costs a little earliness
/// or work and never makes an answer late: "yes" lets the certified time stand, "no" asks the
/// certified routines for a later one. Symmetric.
bool SeemToOverlap(const BoundPair& pair, double time);

}  // namespace collision::intersection
