// The root finder in plain doubles, with a proven error: decides nearly all pairs.
#pragma once

#include "collision_core/numeric/moving_ball.h"

namespace collision::numeric {

/// The ball of a relative motion, rounded outward: its reach includes an allowance of doubt0 +
/// doubt1 δ + doubt2 δ² [m] for the rounding of its numbers. The true ball lies inside it, and
/// contains the ball with a reach smaller by twice the allowance.
struct QuickApproach {
  QuickBall ball;
  double doubt0, doubt1;
  double doubt2 = 0;   ///< Above 0 only where accelerations are known or jerk is declared.
  bool bends = false;  ///< Whether ball.bend and ball.s3 may be other than zero.
};

/// The result of the quick root finder.
struct QuickAnswer {
  bool decided;  ///< False: FirstApproach() must go on from `delta`.
  /// Seconds before which there certainly is no approach, whether decided or not. If decided, it is
  /// as tight as FirstApproach()'s; +infinity: never up to the limit.
  double delta;
};

/// The least δ in [0, limit] at which the ball contains the origin: |c + v δ + bend δ²| <= s0 +
/// s1 δ + s2 δ² + s3 δ³.
/// Undecided where a few units in the last place decide (grazing, touching), near triple roots, and
/// beyond the magnitudes for which its errors are proven (1e-140 to 1e140 m): FirstApproach() then
/// goes on from the time certified so far.
///
/// Method: as FirstApproach(), Newton's step on a lower bound, with one allowance each for gap and
/// slope (10 · 2^-53 of the largest terms, derived beside the code) instead of intervals. The
/// answer is accepted only if, at the time δ (1 + 2^-31), the reach provably exceeds the distance.
/// So the answers are as certain and as tight as FirstApproach()'s, only cheaper; and the bits are
/// the same everywhere, because no operation depends on the build.
QuickAnswer QuickFirstApproach(const QuickApproach& approach, double limit);

}  // namespace collision::numeric
