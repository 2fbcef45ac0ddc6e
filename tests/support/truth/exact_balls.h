// Balls that keep their velocity, in exact arithmetic: the one motion that every bound allows, and
// so one that every promise must hold for. No code of the core's; link with gmp.
#pragma once

#include <algorithm>
#include <cstdint>

#include "collision_core/motion/motion_state.h"
#include "tests/support/truth/exact_dyadic.h"
#include "tests/support/truth/exact_polynomial.h"

namespace collision {

/// |p + v t|² against a reach r + w t + h t² >= 0, for two balls seen from one of them. With r
/// alone they touch where the square is at most r²; with w and h the reach of a space-time bound.
struct ExactGap {
  DyadicPolynomial square;  ///< |Δ|², of degree 2.
  DyadicPolynomial reach;   ///< Of degree 2 at most.

  /// |Δ|² − reach²: positive where they are apart.
  DyadicPolynomial Excess() const { return square + Dyadic(-1.0) * (reach * reach); }

  /// Over all of [from, to).
  bool ApartOn(const Dyadic& from, const Dyadic& to) const {
    ProofCounts counts;
    return IsPositive(Excess(), from, to, &counts);
  }
  bool ApartAt(const Dyadic& t) const { return ValueAt(Excess(), t).Sign() > 0; }

  /// Touching for every motion within the bounds, where `reach` is what is certain of it.
  bool TouchesAt(const Dyadic& t) const {
    return ValueAt(reach, t).Sign() >= 0 && ValueAt(Excess(), t).Sign() <= 0;
  }
};

/// A ball that keeps the velocity of its last state.
struct Ballistic {
  motion::MotionState state;
  double radius = 0;
};

/// The gap of two such balls. Time counts from `base` in nanoseconds, and lengths are multiplied by
/// 1e9, so that every coefficient is a dyadic number.
inline ExactGap GapOf(const Ballistic& a, const Ballistic& b, Instant base) {
  const Dyadic nano = Dyadic::Integer(1'000'000'000);
  const auto since = [base](const Ballistic& ball) {
    return Dyadic::Integer(base.nanoseconds()) - Dyadic::Integer(ball.state.stamp.nanoseconds());
  };
  ExactGap gap{{}, {nano * (Dyadic(a.radius) + Dyadic(b.radius))}};
  for (int i = 0; i < 3; ++i) {
    const Dyadic of_a = nano * Dyadic(a.state.p_WA[i]) + Dyadic(a.state.v_WA[i]) * since(a);
    const Dyadic of_b = nano * Dyadic(b.state.p_WA[i]) + Dyadic(b.state.v_WA[i]) * since(b);
    const DyadicPolynomial between = {of_b - of_a,
                                      Dyadic(b.state.v_WA[i]) - Dyadic(a.state.v_WA[i])};
    gap.square = gap.square + between * between;
  }
  return gap;
}

/// The nanosecond in [from, until] at which the balls are nearest, rounded down.
inline Instant NearestWithin(const Ballistic& a, const Ballistic& b, Instant from, Instant until) {
  const DyadicPolynomial square = GapOf(a, b, from).square;
  // Its derivative is square[1] + 2 square[2] t.
  if (square[1].Sign() >= 0 || square[2].Sign() == 0) return from;
  const Dyadic nearest = Dyadic::Quotient(-square[1], square[2].Scaled(1), false);
  const std::int64_t duration = until.nanoseconds() - from.nanoseconds();
  if (!(nearest < Dyadic::Integer(duration))) return until;
  return Instant::FromNanoseconds(from.nanoseconds() + nearest.Floor());
}

}  // namespace collision
