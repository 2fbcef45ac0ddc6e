// When a moving point first comes as near as a growing distance: the one root finder of the
// service.
#pragma once

#include "collision_core/numeric/interval.h"

namespace collision {

/// A relative motion: the distance |d0 + w δ| against the reach S(δ) = s0 + s1 δ + s2 δ², δ >= 0,
/// s2 >= 0.
struct Approach {
  IntervalVector d0;
  IntervalVector w;
  Interval s0, s1, s2;
};

/// The certified lower bound on the least δ in [0, limit] with |d0 + w δ| <= S(δ): no real motion
/// within the intervals reaches it earlier. 0 if they are, or may be, within reach at once;
/// +infinity if never up to `limit` (which may be +infinity). Early by at most max(1e-9 δ, what the
/// intervals' widths force).
///
/// Method: at δ with certified gap g > 0 along the unit vector n, |d| >= n·d, so the gap stays
/// positive until the positive root of a quadratic, computed rounded down: Newton's step on a lower
/// bound, hence never past the root. It ends where the gap is not certified positive within a
/// relative 1e-9 ahead. `start`: nothing reaches it before that, as is known already.
double FirstApproach(const Approach& approach, double limit, double start = 0);

}  // namespace collision
