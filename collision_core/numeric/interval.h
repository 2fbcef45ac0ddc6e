// Interval arithmetic, rounded outward.
#pragma once

#include <Eigen/Core>

namespace collision::numeric {

/// A closed interval of reals. Every operation returns an interval that contains all exact results
/// for operands in the given intervals. Each end is exact where the operation did not round, else
/// off by at most one unit in the last place (one and a half, and always off, where products come
/// near the denormals: rounding.h). An infinite end means that this side is unbounded; zero times
/// it is zero. A lower end is never +infinity unless it was given so, an upper end never −infinity.
///
/// The results are the same bits at every optimisation level, provided that the compiler does not
/// contract a * b + c (-ffp-contract=off). The bodies stand in interval_inline.h, because the
/// certified routines spend nearly all their time there: a sum takes about 1 ns, a product 3 ns, a
/// quotient 4 ns a bound (g++ 12, -O2).
struct Interval {
  double lower = 0;
  double upper = 0;

  constexpr Interval() = default;
  /// Implicit: a double is an interval.
  constexpr Interval(double exact) : lower(exact), upper(exact) {}
  constexpr Interval(double low, double high) : lower(low), upper(high) {}

  bool Contains(double x) const { return lower <= x && x <= upper; }
  double width() const { return upper - lower; }
  double middle() const { return 0.5 * lower + 0.5 * upper; }
};

Interval operator+(Interval a, Interval b);
Interval operator-(Interval a, Interval b);
Interval operator-(Interval a);
Interval operator*(Interval a, Interval b);
/// The quotients; the whole real line if `b` contains 0.
Interval operator/(Interval a, Interval b);
/// The squares: never below 0, and narrower than a * a where `a` contains 0.
Interval Square(Interval a);
/// The square roots. A part of `a` below 0, which only rounding can put there, counts as 0.
Interval Sqrt(Interval a);
/// The absolute values.
Interval Abs(Interval a);
/// The larger of x and y for all x in `a`, y in `b`; exact.
Interval Max(Interval a, Interval b);
/// The smaller of x and y for all x in `a`, y in `b`; exact.
Interval Min(Interval a, Interval b);

/// A vector of intervals: contains every vector whose components lie in them.
struct IntervalVector {
  Interval x, y, z;

  IntervalVector() = default;
  IntervalVector(Interval v_x, Interval v_y, Interval v_z) : x(v_x), y(v_y), z(v_z) {}
  explicit IntervalVector(const Eigen::Vector3d& v) : x(v.x()), y(v.y()), z(v.z()) {}

  Eigen::Vector3d middle() const { return {x.middle(), y.middle(), z.middle()}; }
};

IntervalVector operator+(const IntervalVector& a, const IntervalVector& b);
IntervalVector operator-(const IntervalVector& a, const IntervalVector& b);
IntervalVector operator*(Interval s, const IntervalVector& v);
/// The scalar products.
Interval Dot(const IntervalVector& a, const IntervalVector& b);
/// The Euclidean length; does not overflow or underflow where the result would not.
Interval Norm(const IntervalVector& v);

}  // namespace collision::numeric

#include "collision_core/numeric/interval_inline.h"
