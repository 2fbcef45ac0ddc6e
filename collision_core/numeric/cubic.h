// Cubics with certified coefficients: gaps, reaches and horns are all of this form.
#pragma once

#include "collision_core/numeric/interval.h"

namespace collision::numeric {

/// c0 + c1 x + c2 x² + c3 x³ for every choice of coefficients in the intervals, with x in seconds.
/// Without a declared jerk c3 is zero, exactly, and everything below is what it is for a quadratic,
/// bit for bit.
struct Cubic {
  Interval c0, c1, c2, c3 = {};

  /// The values at x.
  Interval At(double x) const;
  /// The cubic in y = x − `start`.
  Cubic From(double start) const;
  /// The cubic in y = `end` − x.
  Cubic BackwardFrom(double end) const;
};

/// Coefficient by coefficient, outward rounded.
Cubic operator+(const Cubic& a, const Cubic& b);
Cubic operator*(Interval s, const Cubic& a);

/// A certified lower bound on the least x >= 0 with gap − closing x − growth x² <= 0, off by a few
/// units in the last place; +infinity if there is no such x, 0 if gap <= 0. It is the step by which
/// every conservative advancement of the service moves on. Requires growth >= 0.
double FirstZero(double gap, double closing, double growth);

/// The same of gap − closing x − growth x² − jerk x³, with growth of either sign (the way to the
/// other may bend away). Off by less than 2^-40 of itself where the zero is simple, by 2^-20 where
/// it is nearly double; early, never late. Requires jerk >= 0.
///
/// Method. For x <= X the gap is at least gap − closing x − (growth + jerk X) x², so the lesser of
/// X and that quadratic's first zero is certified for any X > 0. The X that loses least is the zero
/// itself: it is estimated in plain doubles, by Newton's method from a side on which it cannot pass
/// the zero. Where the quadratic closes before, the same is done again from there.
double FirstZero(double gap, double closing, double growth, double jerk);

}  // namespace collision::numeric
