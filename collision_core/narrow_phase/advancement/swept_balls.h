// When two balls that move on straight lines, while their radii grow, may touch first.
#pragma once

#include "collision_core/numeric/moving_ball.h"

namespace collision::narrow_phase {

/// A time [s] up to which two balls are apart, given their relative motion: |c + v h| exceeds the
/// reach s0 + s1 h + s2 h² for every h before it; the reach bounds the sum of their radii and of
/// all uncertainty from above. +infinity if that holds up to `duration`. Takes steps of the tangent
/// of the distance: at each h the distance is at least its part along the direction at h, so no
/// step goes too far. Ends after a few steps, or when one gains less than `step_worth` of the
/// duration: the time is then early, never late.
double SweptBallsTouch(const numeric::QuickBall& difference, double duration, double step_worth);

}  // namespace collision::narrow_phase
