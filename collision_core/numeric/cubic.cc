#include "collision_core/numeric/cubic.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/numeric/cube_root.h"

namespace collision::numeric {
namespace {

bool IsZero(Interval c) { return c.lower == 0 && c.upper == 0; }

/// The first zero of gap − closing x − growth x² for growth < 0 and gap > 0; +infinity: none.
double FirstZeroBeforeItRecovers(double gap, double closing, double growth) {
  if (closing <= 0) return kInfinity;
  // The least root, in the form of the two that does not cancel.
  const Interval discriminant = Square(Interval(closing)) + Interval(4) * gap * growth;
  if (discriminant.upper < 0) return kInfinity;
  return (Interval(2) * gap / (Interval(closing) + Sqrt(discriminant))).lower;
}

/// Newton's steps at most: about 6 for a simple zero, about 50 for a double one, and some more to
/// come down from a bound that is far off.
constexpr int kEstimateSteps = 80;

/// A step of a smaller part of x changes the estimate by less than what is added to it.
constexpr double kEstimateProgress = 0x1p-48;

/// The estimate is made larger by this part, so that the quadratic, not X, decides as a rule.
constexpr double kBeyondEstimate = 0x1p-44;

/// Certified steps at most: one or two as a rule, a few more where the gap nearly closes before it
/// opens again.
constexpr int kCertifiedSteps = 48;

/// A certified step of a smaller part of the way is the last one.
constexpr double kCertifiedProgress = 0x1p-42;

/// p(x) = jerk x³ + growth x² + closing x − gap in plain doubles: where it first reaches 0.
struct Estimate {
  double gap, closing, growth, jerk;

  double At(double x) const { return ((jerk * x + growth) * x + closing) * x - gap; }
  double SlopeAt(double x) const { return (3 * jerk * x + 2 * growth) * x + closing; }

  /// From a side where the tangent cannot pass the zero.
  double Newton(double x) const {
    for (int step = 0; step < kEstimateSteps; ++step) {
      const double next = x - At(x) / SlopeAt(x);
      if (!(std::abs(next - x) > kEstimateProgress * std::abs(x))) return next;
      x = next;
    }
    return x;
  }

  /// At and beyond it p >= 0: there jerk x³ exceeds three times each term that is below 0.
  double Beyond() const {
    return std::max({std::max(0.0, -3 * growth / jerk),
                     std::sqrt(std::max(0.0, -3 * closing / jerk)), CubeRoot(3 * gap / jerk)});
  }

  double FirstZero() const {
    // p rises and falls before it rises for good only if growth < 0 < closing: while it rises first
    // it is concave, and a tangent lies above it.
    if (growth < 0 && closing > 0) {
      const double discriminant = growth * growth - 3 * jerk * closing;
      if (discriminant > 0) {
        const double top = closing / (-growth + std::sqrt(discriminant));
        if (At(top) >= 0) return Newton(0);
      }
    }
    // Beyond the inflection p is convex, and it rises where it is above 0.
    return Newton(Beyond());
  }
};

}  // namespace

Interval Cubic::At(double x) const {
  const Interval top = IsZero(c3) ? c2 : c2 + Interval(x) * c3;
  return c0 + Interval(x) * (c1 + Interval(x) * top);
}

Cubic Cubic::From(double start) const {
  if (IsZero(c3)) return {At(start), c1 + Interval(2 * start) * c2, c2, 0};
  const Interval triple = Interval(3) * start * c3;
  return {At(start), c1 + Interval(start) * (Interval(2) * c2 + triple), c2 + triple, c3};
}

Cubic Cubic::BackwardFrom(double end) const {
  const Cubic forward = From(end);
  return {forward.c0, -forward.c1, forward.c2, -forward.c3};
}

Cubic operator+(const Cubic& a, const Cubic& b) {
  return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2, a.c3 + b.c3};
}

Cubic operator*(Interval s, const Cubic& a) { return {s * a.c0, s * a.c1, s * a.c2, s * a.c3}; }

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

double FirstZero(double gap, double closing, double growth, double jerk) {
  if (!(gap > 0)) return 0;
  CORE_CHECK(jerk >= 0, "a reach grows ever faster, or evenly", gap, closing, jerk);
  if (jerk == 0) {
    return growth >= 0 ? FirstZero(gap, closing, growth)
                       : FirstZeroBeforeItRecovers(gap, closing, growth);
  }
  const double estimate = Estimate{gap, closing, growth, jerk}.FirstZero();
  const double beyond = estimate * (1 + kBeyondEstimate);
  const Cubic rest{gap, -closing, -growth, -jerk};
  double x = 0;
  for (int step = 0; step < kCertifiedSteps; ++step) {
    const Cubic seen = step == 0 ? rest : rest.From(x);
    if (!(seen.c0.lower > 0)) return x;
    // Where plain doubles overflow or underflow any end will do.
    const double end = beyond > x && beyond < kInfinity ? beyond - x : std::max(x, 1.0);
    const double steeper = (Interval(jerk) * end - seen.c2).upper;
    const double slope = -seen.c1.lower;
    const double zero = steeper >= 0 ? FirstZero(seen.c0.lower, slope, steeper)
                                     : FirstZeroBeforeItRecovers(seen.c0.lower, slope, steeper);
    const double next = AddDown(x, std::min(zero, end));
    if (!(next < kInfinity && next - x > kCertifiedProgress * next)) return std::max(x, next);
    if (zero >= end * (1 - kCertifiedProgress) && end == beyond - x) return next;
    x = next;
  }
  return x;
}

}  // namespace collision::numeric
