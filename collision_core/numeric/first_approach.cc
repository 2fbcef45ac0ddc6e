#include "collision_core/numeric/first_approach.h"

#include <algorithm>

#include "collision_core/base/check.h"

namespace collision::numeric {
namespace {

/// Steps at most. Newton's method from one side needs about 10 for a simple root and about 50 for a
/// grazing one; at the bound the answer is the time certified so far: early, never late.
constexpr int kStepsMax = 400;

/// Steps after which the curvature of the distance is used too.
constexpr int kTangentSteps = 8;

/// A step shorter than this part of δ is below what the inputs' rounding forces: a few units in the
/// last place of d0 or w move the root by as much.
constexpr double kProgressMin = 0x1p-50;

/// g0 − closing x − growth x², a lower bound on the gap at δ + x.
struct GapBound {
  double gap;
  double closing;
  double growth;
};

/// A vector along the middle of `d`, of a length near 1; the length need not be exact.
IntervalVector Towards(const IntervalVector& d) {
  const Eigen::Vector3d middle = d.middle();
  return IntervalVector(Eigen::Vector3d(middle / middle.cwiseAbs().maxCoeff()));
}

IntervalVector Cross(const IntervalVector& a, const IntervalVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The relative motion as seen from δ.
struct View {
  IntervalVector d;  // The centre at δ.
  IntervalVector n;  // Along d, of any length; all bounds divide by it.
  Interval length;   // Of n.
  Quadratic reach;   // In x.

  /// `reach_upper`: the upper ends of the radius, which alone count.
  View(const IntervalVector& d0, const IntervalVector& w, const Quadratic& reach_upper,
       double delta)
      : d(d0 + Interval(delta) * w),
        n(Towards(d)),
        length(Norm(n)),
        reach(reach_upper.From(delta)) {}

  /// |d + w x| >= n·(d + w x) / |n|: a tangent of the convex distance.
  GapBound Tangent(const IntervalVector& w) const {
    return {(Dot(n, d) / length - reach.c0).lower, (reach.c1 - Dot(n, w) / length).upper,
            reach.c2.upper};
  }

  /// The tangent raised by the distance's curvature, for 0 <= x <= x_max. With u = n·(d + w x)/|n|
  /// and v the part of d + w x across n, |d + w x| − u = v² / (|d + w x| + u) >= v² / D, where D =
  /// 2 max |d + w x|, which convexity puts at an end. And |n|² v² = |n×d + (n×w) x|² >= 2
  /// (n×d)·(n×w) x + |n×w|² x²; n×d is next to nothing, but not zero.
  GapBound Curved(const IntervalVector& w, const GapBound& tangent, double x_max) const {
    const Interval farthest = Max(Norm(d), Norm(d + Interval(x_max) * w));
    const Interval divisor = Interval(2) * Square(length) * farthest.upper;
    const IntervalVector across = Cross(n, w);
    const Interval linear = Interval(2) * Dot(Cross(n, d), across) / divisor;
    const Interval square = (Square(across.x) + Square(across.y) + Square(across.z)) / divisor;
    return {tangent.gap, (Interval(tangent.closing) - linear).upper,
            (Interval(tangent.growth) - square).upper};
  }
};

/// FirstZero, for growth of either sign.
double FirstZeroWithin(const GapBound& bound, double x_max) {
  if (bound.growth >= 0) return FirstZero(bound.gap, bound.closing, bound.growth);
  if (bound.closing <= 0) return x_max;
  // 1/x turns the roots around: the least root of g0 − c x + |k| x² is 2 g0 / (c + √(c² − 4 g0
  // |k|)).
  const Interval discriminant =
      Square(Interval(bound.closing)) + Interval(4) * bound.gap * bound.growth;
  if (discriminant.upper < 0) return x_max;
  return (Interval(2) * bound.gap / (Interval(bound.closing) + Sqrt(discriminant))).lower;
}

}  // namespace

double FirstApproach(const MovingBall& difference, double limit, double start) {
  CORE_CHECK(start >= 0, "an approach is searched from its base on", start);
  const IntervalVector d0 = difference.centre(), w = difference.velocity;
  const Quadratic reach = difference.reach();
  const Quadratic reach_upper{reach.c0.upper, reach.c1.upper, reach.c2.upper};
  double delta = start;
  double last_step = 0;
  for (int count = 0; count < kStepsMax; ++count) {
    const View view(d0, w, reach_upper, delta);
    const GapBound tangent = view.Tangent(w);
    if (!(tangent.gap > 0)) return delta;
    double step = FirstZero(tangent.gap, tangent.closing, tangent.growth);
    if (count >= kTangentSteps && step < kInfinity) {
      const double x_max = std::max(2 * step, last_step);
      const double curved = FirstZeroWithin(view.Curved(w, tangent, x_max), x_max);
      step = std::max(step, std::min(curved, x_max));
    }
    const double next = AddDown(delta, step);
    if (step == kInfinity || next > limit) return kInfinity;
    if (next - delta <= kProgressMin * delta) return next;
    delta = next;
    last_step = step;
  }
  return delta;
}

}  // namespace collision::numeric
