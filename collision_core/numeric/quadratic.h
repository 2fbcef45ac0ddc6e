// Quadratics with certified coefficients: gaps, reaches and horns are all of this form.
#pragma once

#include "collision_core/numeric/interval.h"

namespace collision::numeric {

/// c0 + c1 x + c2 x² for every choice of coefficients in the intervals. Gaps, reaches and horns are
/// all of this form, with x in seconds.
struct Quadratic {
  Interval c0, c1, c2;

  /// The values at x.
  Interval At(double x) const { return c0 + Interval(x) * (c1 + Interval(x) * c2); }
  /// The quadratic in y = x − `start`.
  Quadratic From(double start) const;
  /// The quadratic in y = `end` − x.
  Quadratic BackwardFrom(double end) const;
};

/// Coefficient by coefficient, outward rounded.
Quadratic operator+(const Quadratic& a, const Quadratic& b);
Quadratic operator*(Interval s, const Quadratic& a);

/// A certified lower bound on the least x >= 0 with gap − closing x − growth x² <= 0, off by a few
/// units in the last place; +infinity if there is no such x, 0 if gap <= 0. It is the step by which
/// every conservative advancement of the service moves on. Requires growth >= 0.
double FirstZero(double gap, double closing, double growth);

}  // namespace collision::numeric
