// Interval arithmetic, rounded outward.
#pragma once

#include <Eigen/Core>

namespace collision {

/// A closed interval of reals. Every operation returns an interval that contains all exact results
/// for operands in the given intervals; each end is off by at most one unit in the last place
/// where the operation rounded, and exact where it did not (one and a half, always, where products
/// come near the denormals; see rounding.h). An end may be infinite: then that side is unbounded,
/// and zero times it is zero. Lower ends are never +infinity unless given so, upper never
/// −infinity.
struct Interval {
  double lower = 0;
  double upper = 0;

  constexpr Interval() = default;
  constexpr Interval(double exact)
      : lower(exact), upper(exact) {}  // NOLINT: a double is an interval
  constexpr Interval(double lower, double upper) : lower(lower), upper(upper) {}

  bool Contains(double x) const { return lower <= x && x <= upper; }
  double width() const { return upper - lower; }
  double middle() const { return 0.5 * lower + 0.5 * upper; }
};

Interval operator+(Interval a, Interval b);
Interval operator-(Interval a, Interval b);
Interval operator-(Interval a);
Interval operator*(Interval a, Interval b);
/// If `b` contains 0: everything.
Interval operator/(Interval a, Interval b);
Interval Square(Interval a);
/// The part of `a` below 0 counts as 0 (it can only be there by rounding).
Interval Sqrt(Interval a);
Interval Abs(Interval a);
Interval Max(Interval a, Interval b);
Interval Min(Interval a, Interval b);

/// A vector of intervals.
struct IntervalVector {
  Interval x, y, z;

  IntervalVector() = default;
  IntervalVector(Interval x, Interval y, Interval z) : x(x), y(y), z(z) {}
  explicit IntervalVector(const Eigen::Vector3d& v) : x(v.x()), y(v.y()), z(v.z()) {}

  Eigen::Vector3d middle() const { return {x.middle(), y.middle(), z.middle()}; }
};

IntervalVector operator+(const IntervalVector& a, const IntervalVector& b);
IntervalVector operator-(const IntervalVector& a, const IntervalVector& b);
IntervalVector operator*(Interval s, const IntervalVector& v);
Interval Dot(const IntervalVector& a, const IntervalVector& b);
/// Euclidean length; does not overflow or underflow where the result would not.
Interval Norm(const IntervalVector& v);

}  // namespace collision

#include "collision_core/numeric/interval_inline.h"
