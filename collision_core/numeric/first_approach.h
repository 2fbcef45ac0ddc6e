// The certified root finder: when a moving point first comes as near as a growing distance.
//
// At δ, with n along d = d0 + w δ, the distance has the tangent |d(δ + x)| >= n·(d + w x) / |n| for
// all x, whatever n is. Less the reach this is a quadratic in x, bounded below by intervals; until
// its first zero, rounded down, nothing can meet. That is Newton's step on a lower bound: never
// past the root, quadratic near a simple root, halving near a double one.
//
// Near a triple root (distance and reach share value, slope and curvature) a tangent creeps, so
// after eight steps the curvature of the distance is added: with v the part of d + w x across n, |d
// + w x| >= u + v² / (2 max |d + w x|) on [0, x_max], u the part along n. With it, no distribution
// tested needs more than 120 of the 400 steps allowed. At that bound the time certified so far is
// the answer: early, never late.
//
// The search stops where the gap is no longer certified positive, or where a step is shorter than
// 2^-50 δ. Both mean that a few units in the last place of the inputs decide. Two agents that only
// draw level at infinity (the gap falls like 1/δ) therefore end where the gap has fallen below
// rounding.
#pragma once

#include "collision_core/numeric/moving_ball.h"

namespace collision::numeric {

/// A certified lower bound on the least δ in [0, limit] at which the ball of a relative motion
/// (Difference() of two balls) contains the origin: with d(δ) its centre and S(δ) its radius,
/// |d(δ)| <= S(δ). No real motion within the intervals reaches it earlier. 0 if the two are, or may
/// be, within reach at once; +infinity if never up to `limit` (which may be +infinity). Early by at
/// most max(1e-9 δ, what the widths of the intervals force). `start` [s]: a time before which it is
/// already known that nothing is within reach. The method is derived at the head of this file.
double FirstApproach(const MovingBall& difference, double limit, double start = 0);

}  // namespace collision::numeric
