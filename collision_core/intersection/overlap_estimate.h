// A first test of what directions and speed caps change, in plain doubles.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision::intersection {

/// Whether the capped balls and the boxes come within `margin` of each other too, `time` seconds
/// after `base`, when the balls of the horns do. The answer may be wrong by rounding, which costs a
/// little earliness or work and never makes an answer late: "yes" lets the certified time stand,
/// "no" asks the certified routines for a later one. Symmetric.
bool SeemToOverlap(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, Instant base,
                   double margin, double time);

}  // namespace collision::intersection
