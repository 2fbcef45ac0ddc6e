#include "collision_core/broad_phase/filter/pair_filter.h"

#include <cmath>

#include "collision_core/numeric/first_approach_quick.h"
#include "collision_core/numeric/rounding.h"

namespace collision::broad_phase {
namespace {

/// Tangent steps at most; the time certified so far is then the answer.
constexpr int kTangentsMax = 6;

/// What squares lose by rounding, as a part of the squares of reach, distance and way: eight times
/// what they do lose.
constexpr double kSquareLoss = 0x1p-44;

/// What a gap and its slope lose by rounding, as a part of their terms; derived at EarlierBound().
constexpr double kGapLoss = 0x1p-46;

/// A step is made shorter by more than its root's own rounding.
constexpr double kStepShare = 1 - 0x1p-40;

/// A step below this part of the time so far ends the search: the next one would add nothing.
constexpr double kWorthAStep = 1e-9;

// Two tests show that the balls stay apart. Along the direction from one centre to the other at the
// start the gap is concave in time: positive at both ends, it is positive in between. And the least
// distance of the two lines may exceed the reach at the end. What rounding takes is less than 2^-48
// of distances, ways and reaches; it is added to the reach.
bool StraightOnesComeNear(const numeric::QuickBall& difference, double last) {
  const double(&c)[3] = difference.c, (&v)[3] = difference.v;
  const double s0 = difference.s0;
  double square = 0, away = 0, speed_square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    square += c[axis] * c[axis];
    away += c[axis] * v[axis];
    speed_square += v[axis] * v[axis];
  }
  const double grown = s0 + last * (difference.s1 + last * (difference.s2 + last * difference.s3));
  const double lost = kSquareLoss * (grown * grown + square + speed_square * last * last);
  const double reach_square = grown * grown + lost;
  const double along = square + away * last;
  if (square > s0 * s0 + lost && along > 0 && along * along > square * reach_square) return false;
  double at = 0;
  if (away < 0) at = speed_square * last > -away ? -away / speed_square : last;
  double closest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = c[axis] + v[axis] * at;
    closest += x * x;
  }
  return !(closest > reach_square);
}

// With d(x) = c + v x, n = d(x) / |d(x)| and g the gap |d(x)| − S(x), the distance lies above its
// tangent, so that nothing meets before the positive root y of
//   g − k y − s2 y²,   k = s1 + 2 s2 x − n·v.
// Rounding: d(x) and S(x) are off by less than 2^-48 of the terms they are sums of, n·v by 2^-50
// |v|; the gap is made smaller and k larger by more than that, and the step shorter by 2^-40, which
// covers the root's own rounding.
double EarlierBoundOfStraight(const numeric::QuickBall& difference, double limit) {
  const double(&c)[3] = difference.c, (&v)[3] = difference.v;
  const double s0 = difference.s0, s1 = difference.s1, s2 = difference.s2;
  const double speed = Length(v), span = Length(c);
  double x = 0;
  for (int tangent = 0; tangent < kTangentsMax; ++tangent) {
    const double at[3] = {c[0] + v[0] * x, c[1] + v[1] * x, c[2] + v[2] * x};
    const double length = Length(at);
    const double reach = s0 + x * (s1 + x * s2);
    const double gap = length - reach - kGapLoss * (span + speed * x + reach);
    if (!(gap > 0)) return x;
    const double along = (at[0] * v[0] + at[1] * v[1] + at[2] * v[2]) / length;
    const double closing = (s1 + 2 * s2 * x - along) + kGapLoss * (s1 + 2 * s2 * x + speed);
    double step = numeric::kInfinity;
    if (s2 > 0) {
      const double root = std::sqrt(closing * closing + 4 * s2 * gap);
      step = closing >= 0 ? 2 * gap / (closing + root) : (root - closing) / (2 * s2);
    } else if (closing > 0) {
      step = gap / closing;
    }
    x += step * kStepShare;
    if (!(x <= limit) || step < kWorthAStep * x) return x;
  }
  return x;
}

}  // namespace

// A bend is part of the reach here.
bool ComeNear(const numeric::QuickBall& difference, double last) {
  return StraightOnesComeNear(difference.bends() ? Straightened(difference) : difference, last);
}

// The quick root finder's allowances for its own rounding leave 2 · 2^-53 of each term, more than
// the difference of two rows loses.
double EarlierBound(const numeric::QuickBall& difference, double limit) {
  if (!difference.bends()) return EarlierBoundOfStraight(difference, limit);
  return numeric::QuickFirstApproach({difference, 0, 0, 0, true}, limit).delta;
}

}  // namespace collision::broad_phase
