// When two bodies that turn fast may first touch, wherever they are in their turns.
#pragma once

#include "collision_core/narrow_phase/swept_pair.h"

namespace collision {

/// A lower bound on the time at which the two may touch, as TouchOf() tells, but with each body that
/// turns taken for all of what it sweeps in a full turn about its axis: the times do not depend on
/// how often it turns. `swept.turning_A` and `turning_B` are without the tangents' deviation.
/// +infinity: not within the duration, its end included.
double RevolvedTouch(const Surface& a, const Surface& b, const SweptPose& swept, double duration,
                     Work* work);

}  // namespace collision
