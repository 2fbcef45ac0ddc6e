// The filter of one pair, in plain doubles: the last one before the canonical routine.
#pragma once

#include <cmath>

#include "collision_core/numeric/moving_ball.h"

namespace collision::broad_phase {

/// The length of three components; rounded to nearest at each step.
inline double Length(const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// By how much the filter's bounds and the canonical answer together may be early.
inline constexpr double kFilterEarliness = 1 - 4e-9;

/// False if the ball of a relative motion certainly does not contain the origin in [0, last] s.
bool ComeNear(const numeric::QuickBall& difference, double last);

/// A lower bound on the time at which the ball of a relative motion first contains the origin [s];
/// above `limit`: not within it. Off by a relative 1e-9 or so.
double EarlierBound(const numeric::QuickBall& difference, double limit);

/// False if the canonical answer of the pair is certainly later than `last` [s], also where that
/// answer is early.
inline bool MayMeetBy(const numeric::QuickBall& difference, double last) {
  return ComeNear(difference, last / kFilterEarliness) &&
         kFilterEarliness * EarlierBound(difference, last) <= last;
}

}  // namespace collision::broad_phase
