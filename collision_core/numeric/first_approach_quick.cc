#include "collision_core/numeric/first_approach_quick.h"

#include <cmath>

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::numeric {
namespace {

/// Steps before the interval arithmetic is asked: a simple root takes about 5.
constexpr int kStepsMax = 24;

// Below, ε is kUnitRoundoff.

/// The error of an evaluation, relative to the greatest terms; derived at View.
constexpr double kErrorOfGap = 10 * kUnitRoundoff;
constexpr double kErrorOfSlope = 10 * kUnitRoundoff;

/// A step's formula has at most six roundings, each of positive numbers.
constexpr double kLessStep = 1 - 8 * kUnitRoundoff;

/// Distances between these have squares whose rounding is relative: what underflows beside them is
/// less than 2^-140 of the allowances.
constexpr double kDistanceMin = 0x1p-465, kDistanceMax = 0x1p+465;

/// Speeds are zero or at least this: beside the allowance on a slope, 2^-450, what underflows there
/// (2^-1074 over the least distance) is nothing.
constexpr double kSpeedMin = 0x1p-400;

/// Likewise discriminants.
constexpr double kDiscriminantMin = 0x1p-900, kDiscriminantMax = 0x1p+1000;

/// The answer may be early by this, relative: less than 1e-9.
constexpr double kAhead = 1 + 0x1p-31;

/// A step below this part of δ ends the search: the next one would be some 2^-24.
constexpr double kNearlyThere = 0x1p-12;

/// The approach seen from δ, with its errors.
///
/// Gap. x_i = c_i + v_i δ is off by ε (|c_i| + 2 |v_i| δ) at most, together by 2ε (C + V δ), where
/// C and V are the sums of |c_i| and |v_i|. Squares, two sums and the root give |x| with 3ε:
/// squares ε, sums 2ε, halved by the root, and its own ε. The reach S = s0 + δ (s1 + δ s2) has four
/// roundings, the difference one more. Together less than 6ε (C + V δ) + 6ε S, second order
/// included.
///
/// Slope. The tangent holds for any direction, so x is one without error. x·v has three roundings a
/// term, |x| 3ε and the quotient one: 7ε V. s1 + 2 δ s2 has three roundings, the difference one
/// more.
struct View {
  const QuickApproach& approach;
  double scale_v, delta;
  double x[3];
  double distance, reach, error;

  View(const QuickApproach& given, double scale_c, double velocity_scale, double offset)
      : approach(given),
        scale_v(velocity_scale),
        delta(offset),
        x{ball().c[0] + ball().v[0] * delta, ball().c[1] + ball().v[1] * delta,
          ball().c[2] + ball().v[2] * delta},
        distance(std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])),
        reach(ball().s0 + delta * (ball().s1 + delta * ball().s2)),
        error(kErrorOfGap * (scale_c + scale_v * delta + reach)) {}

  const QuickBall& ball() const { return approach.ball; }

  bool in_range() const { return distance >= kDistanceMin && distance <= kDistanceMax; }
  double gap_lower() const { return (distance - reach) - error; }

  /// Whether the true distance is certainly within the true reach.
  bool overlaps() const {
    const double doubt = 2 * (error + approach.doubt0 + approach.doubt1 * delta);
    return reach <= kDistanceMax && distance + doubt <= reach;
  }

  /// How fast the tangent's gap closes, at most.
  double closing() const {
    const double along = (x[0] * ball().v[0] + x[1] * ball().v[1] + x[2] * ball().v[2]) / distance;
    const double growing = ball().s1 + 2 * delta * ball().s2;
    return (growing - along) + kErrorOfSlope * (scale_v + growing);
  }
};

/// A lower bound on the least zero of gap − closing x − growth x², which has one; NaN: the
/// magnitudes are too far apart to say.
double Step(double gap, double closing, double growth) {
  const double discriminant = closing * closing + 4 * growth * gap;
  if (!(discriminant >= kDiscriminantMin && discriminant <= kDiscriminantMax)) return NAN;
  const double root = std::sqrt(discriminant);
  if (closing >= 0) return kLessStep * (2 * gap / (closing + root));
  return kLessStep * ((root - closing) / (2 * growth));
}

double SumOfMagnitudes(const double (&v)[3]) {
  return (std::abs(v[0]) + std::abs(v[1])) + std::abs(v[2]);
}

}  // namespace

QuickAnswer QuickFirstApproach(const QuickApproach& approach, double limit) {
  const QuickBall& ball = approach.ball;
  const double scale_c = SumOfMagnitudes(ball.c), scale_v = SumOfMagnitudes(ball.v);
  const auto arrives = [&](double delta) {
    return View(approach, scale_c, scale_v, delta * kAhead).overlaps();
  };
  const double speeds = scale_v + ball.s1;
  if (speeds > 0 && speeds < kSpeedMin) return {false, 0};
  double delta = 0;
  for (int count = 0; count < kStepsMax; ++count) {
    const View view(approach, scale_c, scale_v, delta);
    if (!view.in_range()) return {view.overlaps(), delta};
    const double gap = view.gap_lower();
    if (!(gap > 0)) return {arrives(delta), delta};
    const double closing = view.closing();
    if (closing <= 0 && ball.s2 == 0) return {true, kInfinity};
    const double step = Step(gap, closing, ball.s2);
    if (!(step < kInfinity)) return {false, delta};
    const double next = AddDown(delta, step);
    if (next > limit) return {true, kInfinity};
    if (step <= kNearlyThere * next && arrives(next)) return {true, next};
    delta = next;
  }
  return {false, delta};
}

}  // namespace collision::numeric
