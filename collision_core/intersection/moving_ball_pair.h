// Two balls in certified arithmetic, as the root finder takes them.
#pragma once

#include <optional>

#include "collision_core/motion/speed_cap.h"
#include "collision_core/numeric/first_approach.h"
#include "collision_core/numeric/seconds.h"

namespace collision::intersection {

/// One agent's ball seen from a base instant: about p_WA + shift + velocity δ, of radius + u(δ).
struct BallPart {
  numeric::IntervalVector p_WA, shift, velocity;
  numeric::Interval radius;
  numeric::Quadratic u;
};

/// The forward horn's.
inline BallPart HornPart(const motion::SpaceTimeBound& bound, Instant base) {
  const numeric::IntervalVector velocity(bound.state.v_WA);
  return {numeric::IntervalVector(bound.state.p_WA),
          numeric::SecondsBetween(bound.state.stamp, base) * velocity, velocity,
          bound.limits.radius, ForwardBall(bound, base).u()};
}

/// The capped ball's, which counts beside the horn's from `start` on; it may lie before the base.
struct CappedPart {
  double start;
  BallPart ball;
};

/// nullopt: no cap is declared, or it never takes over.
inline std::optional<CappedPart> CapPart(const motion::SpaceTimeBound& bound, Instant base) {
  if (!HasSpeedCap(bound.limits)) return std::nullopt;
  const motion::CappedBall ball = CapBall(bound);
  if (ball.from.is_never()) return std::nullopt;
  return CappedPart{numeric::SecondsBetween(base, ball.from).lower,
                    {numeric::IntervalVector(bound.state.p_WA), ball.shift,
                     numeric::IntervalVector(0, 0, 0), bound.limits.radius, ball.UFrom(base)}};
}

/// The relative motion from A to B, with the sum of the radii larger by `margin`. Positions are
/// subtracted first: a scene far from the origin loses only what its inputs lost. Every operation
/// gives the same bits (or the negated ones) when A and B change places: negation is exact, and a +
/// b is b + a.
inline numeric::Approach ApproachOf(const BallPart& a, const BallPart& b, double margin) {
  const numeric::Quadratic u = a.u + b.u;
  return {(b.p_WA - a.p_WA) + (b.shift - a.shift), b.velocity - a.velocity,
          ((a.radius + b.radius) + margin) + u.c0, u.c1, u.c2};
}

}  // namespace collision::intersection
