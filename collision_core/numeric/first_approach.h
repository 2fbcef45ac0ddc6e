// The certified root finder: when a moving point first comes as near as a growing distance.
//
// At δ, with n along d = d0 + w δ + h δ² (h is half the difference of the known accelerations), the
// distance has the tangent |d(δ + x)| >= n·(d + (w + 2 h δ) x + h x²) / |n| for all x, whatever n
// is. Less the reach this is a cubic in x, bounded below by intervals; until its first zero,
// rounded down, nothing can meet. That is Newton's step on a lower bound: never past the root,
// quadratic near a simple root, halving near a double one. Without known accelerations and jerk it
// is a quadratic, bit for bit.
//
// Near a triple root (distance and reach agree in value, slope and curvature) the tangent step
// makes little progress. After eight steps the bound therefore adds the curvature of the distance.
// Let y be the component of the centre along n and z the one perpendicular to n; then on [0, x_max]
// the distance is at least y + |z|² / (2 · the greatest distance there). No tested distribution
// needs more than 120 of the 400 steps allowed; after 400 steps the time certified so far is
// returned: early, never late.
//
// The search stops where the gap is no longer certified positive, or where a step is shorter than
// 2^-50 δ. Both mean that a few units in the last place of the inputs decide. Two agents that
// approach only asymptotically (the gap falls like 1/δ) therefore end where the gap has fallen
// below rounding.
#pragma once

#include "collision_core/numeric/moving_ball.h"

namespace collision::numeric {

/// A certified lower bound on the least δ in [0, limit] at which the ball of a relative motion
/// (Difference() of two balls) contains the origin: with d(δ) its centre and S(δ) its radius,
/// |d(δ)| <= S(δ). No real motion within the intervals reaches it earlier. `start` [s]: nothing
/// is within reach before it. Returns `start` if the two are, or may be, within reach there;
/// +infinity if they never are up to `limit` (which may be +infinity). Early by at most max(1e-9 δ,
/// what the widths of the intervals force). The method is derived at the head of this file.
double FirstApproach(const MovingBall& difference, double limit, double start = 0);

}  // namespace collision::numeric
