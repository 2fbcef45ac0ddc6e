#include "collision_core/numeric/first_approach_quick.h"

#include <algorithm>
#include <cmath>

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/cube_root.h"
#include "collision_core/numeric/rounding.h"

namespace collision::numeric {
namespace {

/// Steps before the interval arithmetic is asked: a simple root takes about 5.
constexpr int kStepsMax = 24;

// Below, ε is kUnitRoundoff.

/// The error of an evaluation, relative to the greatest terms; derived at View.
constexpr double kErrorOfGap = 10 * kUnitRoundoff;
constexpr double kErrorOfSlope = 10 * kUnitRoundoff;
constexpr double kErrorOfBentSlope = 13 * kUnitRoundoff;

/// The error of how fast the slope falls, relative to the greatest terms; derived at View.
constexpr double kErrorOfGrowth = 12 * kUnitRoundoff;

/// A step's formula has at most six roundings, each of positive numbers.
constexpr double kLessStep = 1 - 8 * kUnitRoundoff;

/// How often the end of a step with jerk is brought nearer.
constexpr int kRoundsOfJerk = 4;

/// Distances between these have squares whose rounding is relative: what underflows beside them is
/// less than 2^-140 of the allowances.
constexpr double kDistanceMin = 0x1p-465, kDistanceMax = 0x1p+465;

/// Speeds are zero or at least this: beside the allowance on a slope, 2^-450, what underflows there
/// (2^-1074 over the least distance) is nothing.
constexpr double kSpeedMin = 0x1p-400;

/// Likewise bends and jerks, where there are any.
bool IsUsual(double bends, double jerk) {
  constexpr double kMin = 0x1p-300, kMax = 0x1p+300;
  const auto usual = [](double x) { return x == 0 || (x >= kMin && x <= kMax); };
  return usual(bends) && usual(jerk);
}

/// Likewise discriminants.
constexpr double kDiscriminantMin = 0x1p-900, kDiscriminantMax = 0x1p+1000;

/// The answer may be early by this, relative: less than 1e-9.
constexpr double kAhead = 1 + 0x1p-31;

/// A step below this part of δ ends the search: the next one would be some 2^-24.
constexpr double kNearlyThere = 0x1p-12;

double SumOfMagnitudes(const double (&v)[3]) {
  return (std::abs(v[0]) + std::abs(v[1])) + std::abs(v[2]);
}

/// The magnitudes of a ball's centre, velocity and bend.
struct Scales {
  double c, v, h;

  explicit Scales(const QuickBall& ball)
      : c(SumOfMagnitudes(ball.c)), v(SumOfMagnitudes(ball.v)), h(SumOfMagnitudes(ball.bend)) {}
};

/// The approach seen from δ, with its errors; `kBends` is QuickApproach::bends.
///
/// Gap. x_i = c_i + v_i δ is off by ε (|c_i| + 2 |v_i| δ) at most, together by 2ε (C + V δ), where
/// C and V are the sums of |c_i| and |v_i|. Squares, two sums and the root give |x| with 3ε:
/// squares ε, sums 2ε, halved by the root, and its own ε. The reach S = s0 + δ (s1 + δ s2) has four
/// roundings, the difference one more. Together less than 6ε (C + V δ) + 6ε S, second order
/// included. With x_i = c_i + δ (v_i + δ h_i) each term has up to four roundings, together 4ε (C +
/// V δ + H δ²); S has six: less than 8ε of all.
///
/// Slope. The tangent holds for any direction, so x is one without error. x·v has three roundings a
/// term, |x| 3ε and the quotient one: 7ε V. s1 + 2 δ s2 has three roundings, the difference one
/// more. With v + 2 δ h for v there are two more, 9ε (V + 2 H δ), and 3 s3 δ² adds three.
///
/// Growth. x·h likewise, 7ε H; s2 + 3 s3 δ has three roundings, the difference one more. The jerk
/// s3 has none.
template <bool kBends>
struct View {
  const QuickApproach& approach;
  double scale_v, scale_h, delta;
  double x[3];
  double distance, reach, error;

  View(const QuickApproach& given, const Scales& scales, double offset)
      : approach(given),
        scale_v(scales.v),
        scale_h(scales.h),
        delta(offset),
        x{PlaceOf(0), PlaceOf(1), PlaceOf(2)},
        distance(std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])),
        reach(ReachOf()),
        error(kErrorOfGap * (scales.c + WayOf() + reach)) {}

  const QuickBall& ball() const { return approach.ball; }

  double PlaceOf(int axis) const {
    if (!kBends) return ball().c[axis] + ball().v[axis] * delta;
    return ball().c[axis] + delta * (ball().v[axis] + delta * ball().bend[axis]);
  }
  double ReachOf() const {
    const double top = kBends ? ball().s2 + delta * ball().s3 : ball().s2;
    return ball().s0 + delta * (ball().s1 + delta * top);
  }
  double WayOf() const { return kBends ? delta * (scale_v + delta * scale_h) : scale_v * delta; }

  bool in_range() const { return distance >= kDistanceMin && distance <= kDistanceMax; }
  double gap_lower() const { return (distance - reach) - error; }

  /// Whether the true distance is certainly within the true reach.
  bool overlaps() const {
    const double doubt1 = kBends ? approach.doubt1 + approach.doubt2 * delta : approach.doubt1;
    const double doubt = 2 * (error + approach.doubt0 + doubt1 * delta);
    return reach <= kDistanceMax && distance + doubt <= reach;
  }

  /// How much of a vector points along x.
  double Along(double v_x, double v_y, double v_z) const {
    return (x[0] * v_x + x[1] * v_y + x[2] * v_z) / distance;
  }

  /// How fast the tangent's gap closes, at most.
  double closing() const {
    const double(&v)[3] = ball().v, (&h)[3] = ball().bend;
    double along, scale = scale_v, growing = ball().s1 + 2 * delta * ball().s2;
    if (kBends) {
      const double twice = 2 * delta;
      along = Along(v[0] + twice * h[0], v[1] + twice * h[1], v[2] + twice * h[2]);
      scale += twice * scale_h;
      growing += 3 * delta * delta * ball().s3;
    } else {
      along = Along(v[0], v[1], v[2]);
    }
    return (growing - along) + (kBends ? kErrorOfBentSlope : kErrorOfSlope) * (scale + growing);
  }

  /// How fast that grows, halved: at most, and not below 0.
  double growth() const {
    if (!kBends) return ball().s2;
    const double(&h)[3] = ball().bend;
    const double growing = ball().s2 + 3 * delta * ball().s3;
    const double error_of_growth = kErrorOfGrowth * (scale_h + growing);
    return std::max(0.0, (growing - Along(h[0], h[1], h[2])) + error_of_growth);
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

/// The same with a jerk > 0. For x <= X the gap is at least gap − closing x − (growth + jerk X) x²,
/// so the lesser of X and that quadratic's zero is certified for any X > 0. The first X is where
/// growth or jerk alone would do it; the next ones come nearer from above.
double StepWithJerk(double gap, double closing, double growth, double jerk) {
  double end = closing > 0 || growth > 0 ? Step(gap, closing, growth) : kInfinity;
  if (!(jerk * end * end * end <= gap)) end = CubeRoot(gap / jerk);
  double step = 0;
  for (int round = 0; round < kRoundsOfJerk; ++round) {
    const double zero = Step(gap, closing, (growth + jerk * end) * kFewRoundingsUp);
    if (!(zero < kInfinity)) return NAN;
    step = std::max(step, std::min(zero, end));
    if (!(zero < end)) break;
    end = 0.5 * (zero + end);
  }
  return step;
}

template <bool kBends>
QuickAnswer Search(const QuickApproach& approach, double limit) {
  const QuickBall& ball = approach.ball;
  const Scales scales(ball);
  const auto arrives = [&](double delta) {
    return View<kBends>(approach, scales, delta * kAhead).overlaps();
  };
  const double speeds = scales.v + ball.s1;
  if (speeds > 0 && speeds < kSpeedMin) return {false, 0};
  const double jerk = kBends ? ball.s3 : 0;
  if (kBends && !IsUsual(scales.h, jerk)) return {false, 0};
  double delta = 0;
  for (int count = 0; count < kStepsMax; ++count) {
    const View<kBends> view(approach, scales, delta);
    if (!view.in_range()) return {view.overlaps(), delta};
    const double gap = view.gap_lower();
    if (!(gap > 0)) return {arrives(delta), delta};
    const double closing = view.closing(), growth = view.growth();
    if (closing <= 0 && growth == 0 && jerk == 0) return {true, kInfinity};
    const double step =
        jerk > 0 ? StepWithJerk(gap, closing, growth, jerk) : Step(gap, closing, growth);
    if (!(step < kInfinity)) return {false, delta};
    const double next = AddDown(delta, step);
    if (next > limit) return {true, kInfinity};
    if (step <= kNearlyThere * next && arrives(next)) return {true, next};
    delta = next;
  }
  return {false, delta};
}

}  // namespace

QuickAnswer QuickFirstApproach(const QuickApproach& approach, double limit) {
  return approach.bends ? Search<true>(approach, limit) : Search<false>(approach, limit);
}

}  // namespace collision::numeric
