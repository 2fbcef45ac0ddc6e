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

/// g0 − closing x − growth x² − jerk x³, a lower bound on the gap at δ + x.
struct GapBound {
  double gap;
  double closing;
  double growth;
  double jerk;

  double FirstZero() const { return numeric::FirstZero(gap, closing, growth, jerk); }
};

/// A vector along the middle of `d`, of a length near 1; the length need not be exact.
IntervalVector Towards(const IntervalVector& d) {
  const Eigen::Vector3d middle = d.middle();
  return IntervalVector(Eigen::Vector3d(middle / middle.cwiseAbs().maxCoeff()));
}

IntervalVector Cross(const IntervalVector& a, const IntervalVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Interval SquaredNorm(const IntervalVector& a) { return Square(a.x) + Square(a.y) + Square(a.z); }

/// The relative motion as seen from δ: its centre is at d + w x + h x² after x more seconds.
struct View {
  bool bends;
  IntervalVector d, w, h;
  IntervalVector n;  // Along d, of any length; all bounds divide by it.
  Interval length;   // Of n.
  Cubic reach;       // In x.

  /// `reach_upper`: the upper ends of the radius, which alone count.
  View(const MovingBall& difference, const Cubic& reach_upper, double delta)
      : bends(difference.bends),
        d(difference.centre() + difference.PathTo(delta)),
        w(difference.VelocityAt(delta)),
        h(difference.bend),
        n(Towards(d)),
        length(Norm(n)),
        reach(reach_upper.From(delta)) {}

  /// |d + w x + h x²| >= n·(d + w x + h x²) / |n|: a tangent of the convex length. A reach that
  /// runs backward loses its last term: for x >= 0 that only makes it larger.
  GapBound Tangent() const {
    return {(Dot(n, d) / length - reach.c0).lower, (reach.c1 - Dot(n, w) / length).upper,
            bends ? (reach.c2 - Dot(n, h) / length).upper : reach.c2.upper,
            std::max(0.0, reach.c3.upper)};
  }

  /// The tangent raised by the curvature of the length, for 0 <= x <= x_max. With u = n·(d + w x +
  /// h x²)/|n| and v the part of d + w x + h x² across n, the length less u is v² / (length + u) >=
  /// v² / D, where D = 2 max(|d|, |d + w x_max|) + 2 |h| x_max² is no less than twice the greatest
  /// length. And |n|² v² = |A + B x + C x²|² with A = n×d, B = n×w and C = n×h, which is at least
  /// 2 A·B x + (|B|² + 2 A·C) x² + 2 B·C x³; A is next to nothing, but not zero.
  GapBound Curved(const GapBound& tangent, double x_max) const {
    Interval farthest = Max(Norm(d), Norm(d + Interval(x_max) * w));
    if (bends) farthest = farthest + Norm(h) * Square(Interval(x_max));
    const Interval divisor = Interval(2) * Square(length) * farthest.upper;
    const IntervalVector at_d = Cross(n, d), across = Cross(n, w);
    const Interval linear = Interval(2) * Dot(at_d, across) / divisor;
    GapBound raised = tangent;
    raised.closing = (Interval(tangent.closing) - linear).upper;
    if (!bends) {
      raised.growth = (Interval(tangent.growth) - SquaredNorm(across) / divisor).upper;
      return raised;
    }
    const IntervalVector bending = Cross(n, h);
    const Interval square = (SquaredNorm(across) + Interval(2) * Dot(at_d, bending)) / divisor;
    const Interval cube = Interval(2) * Dot(across, bending) / divisor;
    raised.growth = (Interval(tangent.growth) - square).upper;
    raised.jerk = std::max(0.0, (Interval(tangent.jerk) - cube).upper);
    return raised;
  }
};

}  // namespace

double FirstApproach(const MovingBall& difference, double limit, double start) {
  CORE_CHECK(start >= 0, "an approach is searched from its base on", start);
  const Cubic reach = difference.reach();
  const Cubic reach_upper{reach.c0.upper, reach.c1.upper, reach.c2.upper, reach.c3.upper};
  double delta = start;
  double last_step = 0;
  for (int count = 0; count < kStepsMax; ++count) {
    const View view(difference, reach_upper, delta);
    const GapBound tangent = view.Tangent();
    if (!(tangent.gap > 0)) return delta;
    double step = tangent.FirstZero();
    if (count >= kTangentSteps && step < kInfinity) {
      const double x_max = std::max(2 * step, last_step);
      const double curved = view.Curved(tangent, x_max).FirstZero();
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
