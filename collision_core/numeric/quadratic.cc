#include "collision_core/numeric/quadratic.h"

#include "collision_core/base/check.h"

namespace collision::numeric {

Quadratic Quadratic::From(double start) const {
  return {At(start), c1 + Interval(2 * start) * c2, c2};
}

Quadratic Quadratic::BackwardFrom(double end) const {
  const Quadratic forward = From(end);
  return {forward.c0, -forward.c1, forward.c2};
}

Quadratic operator+(const Quadratic& a, const Quadratic& b) {
  return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2};
}

Quadratic operator*(Interval s, const Quadratic& a) { return {s * a.c0, s * a.c1, s * a.c2}; }

double FirstZero(double gap, double closing, double growth) {
  if (!(gap > 0)) return 0;
  CORE_CHECK(growth >= 0, "a gap closes ever faster, or evenly", gap, closing, growth);
  if (growth == 0) return closing > 0 ? DivideDown(gap, closing) : kInfinity;
  // The positive root of growth x² + closing x − gap, in the form of the two that does not cancel.
  // The root of the discriminant is a length: Norm keeps it from overflowing where the answer would
  // not.
  const Interval twice_root_of_product = Interval(2) * Sqrt(Interval(growth)) * Sqrt(Interval(gap));
  const Interval root = Norm({closing, twice_root_of_product, 0});
  if (closing >= 0) return (Interval(2) * gap / (Interval(closing) + root)).lower;
  return ((root - Interval(closing)) / (Interval(2) * growth)).lower;
}

}  // namespace collision::numeric
