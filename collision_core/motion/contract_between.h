// The part of the contract that counts between two states: can one motion lead from the one to the
// other?
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// How far apart the forward ball of `before` and the backward ball of `next` come at some instant
/// between the two, at least [m]; 0 unless it is proved that they are apart there. Whoever moved
/// under the declaration from the one state to the other is in both balls all the while, so beyond
/// rounding at the sender more than 0 is a breach. With T = next.stamp − before.stamp:
///
///   max over s in [0, T] of |D(s)| − R(s),   D(s) = p + v s − p' + v' (T − s),
///   R(s) = u(s) + u'(T − s), without errors ½ M s² + ½ M (T − s)².
///
/// s = T is the check of the position, s = 0 the same backward in time. Where a motion is along one
/// line, there is one if and only if this is 0 and |v' − v| <= M T; README.md beside this file.
/// Same declaration, skew and order of stamps as CheckContract(). Of honest states mostly a glance
/// in plain doubles; allocates nothing.
double GapBetween(const SpaceTimeBound& before, const MotionState& next);

}  // namespace collision
