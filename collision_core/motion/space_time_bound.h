// Where an agent can be, given only one state.
#pragma once

#include "collision_core/motion/motion_state.h"
#include "collision_core/numeric/quadratic.h"

namespace collision {

/// Everything agent A can reach while |acceleration| <= M, given its state at `state.stamp`.
///
/// In space-time a parabolic horn. With τ = t − stamp and σ = |τ| + κ all of A lies in the ball
///   centre c(t) = p_WA + v_WA τ,   radius ρ(t) = r + u(t),
///   u(t) = ε_p + |v_WA| κ + ε_v σ + ½ M σ (σ + h).
/// It holds forward (τ >= 0) up to the next discontinuity, and backward (τ <= 0) down to the last.
/// Source: Hubbard, "Collision detection for interactive graphics applications", IEEE TVCG 1(3),
/// 1995, section 3; ε, κ and h are derived in README.md beside this file.
struct SpaceTimeBound {
  MotionState state;
  AgentDeclaration declaration;
  double skew = 0;  ///< κ [s], >= 0: the sender's clock is off by at most this.
};

/// Whether the agent stays where it is, wherever that is: at rest for certain, and not able to
/// accelerate, or not allowed to move. Two such agents never meet.
inline bool NeverMoves(const SpaceTimeBound& bound) {
  return bound.state.v_WA.isZero(0) && bound.state.velocity_error == 0 &&
         (bound.declaration.acceleration_max == 0 || bound.declaration.speed_max == 0);
}

/// u of a bound, as a quadratic in the seconds δ >= 0 after a base instant, with the centre's line:
///   centre(δ) = centre + velocity δ,   u(δ) = u0 + u1 δ + u2 δ²  (convex: u2 >= 0).
/// Each coefficient's interval contains the exact one.
struct MovingBall {
  IntervalVector centre;
  IntervalVector velocity;
  Interval u0, u1, u2;

  Quadratic u() const { return {u0, u1, u2}; }
};

/// The forward horn from `base` on. Requires base >= state.stamp.
MovingBall ForwardBall(const SpaceTimeBound& bound, Instant base);

/// The backward horn from `base` on, valid while base + δ <= state.stamp. Requires base <=
/// state.stamp.
MovingBall BackwardBall(const SpaceTimeBound& bound, Instant base);

/// The part ½ M σ (σ + h) of u alone, which a direction makes smaller. Requires base >=
/// state.stamp.
Quadratic ForwardDeviation(const SpaceTimeBound& bound, Instant base);

/// The rest of u.
Quadratic ForwardErrors(const SpaceTimeBound& bound, Instant base);

/// How far the deviation reaches along each axis while the declared direction d holds, as a
/// fraction of ½ M σ(σ + h): towards +x it is 1 if d_x >= 0, else √(d_y² + d_z²); towards −x as if
/// d were −d.
struct DirectionalReach {
  Interval upward[3] = {1, 1, 1};
  Interval downward[3] = {1, 1, 1};
};

/// All ones where no direction is declared.
DirectionalReach ReachOfDirection(const MotionState& state);

/// Seconds after `base` up to which the declared direction certainly holds (its end may come κ
/// early); below zero if it does not hold at `base`, +infinity if it never ends.
double DirectionHoldsFor(const SpaceTimeBound& bound, Instant base);

/// An axis-aligned box; faces as intervals that contain the exact ones.
struct FaceBox {
  Interval lower[3];
  Interval upper[3];
};

/// The box of the forward horn at t >= stamp: the ball's box, made smaller by the direction where
/// it holds.
FaceBox BoxAt(const SpaceTimeBound& bound, Instant t);

/// Likewise with the direction counted or not, whatever its end says.
FaceBox BoxAt(const SpaceTimeBound& bound, Instant t, bool use_direction);

}  // namespace collision
