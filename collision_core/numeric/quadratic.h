// Quadratics with certified coefficients: gaps, reaches and horns are all of this form.
#pragma once

#include "collision_core/numeric/interval.h"

namespace collision {

/// c0 + c1 x + c2 x² for every choice of coefficients in the intervals.
struct Quadratic {
  Interval c0, c1, c2;

  /// The values at x.
  Interval At(double x) const { return c0 + Interval(x) * (c1 + Interval(x) * c2); }
  /// The quadratic in y = x − `start`.
  Quadratic From(double start) const;
  /// The quadratic in y = `end` − x.
  Quadratic BackwardFrom(double end) const;
};

Quadratic operator+(const Quadratic& a, const Quadratic& b);
Quadratic operator*(Interval s, const Quadratic& a);

/// A lower bound, off by a few units in the last place, on the least x >= 0 with gap − closing x −
/// growth x² <= 0; +infinity if there is none. Requires growth >= 0; 0 if gap <= 0.
double FirstZero(double gap, double closing, double growth);

}  // namespace collision
