// Where an agent can be, given only one state.
//
// The bound is a ball that moves and grows. It is known at the stamp: position p, velocity v, and
// the radius r of a ball about the reference point that contains the agent in every orientation.
// With τ = t − stamp, all of the agent lies within r + u(t) of c(t) = p + v τ. The term u(t)
// collects everything that is not known, with σ = |τ| + κ:
//
//   u(t) = ε_p + |v| κ + ε_v σ + ½ M σ (σ + h)
//
// - M, the acceleration bound (Hubbard). The reference point deviates from uniform motion by e(t) =
//   ∫∫ a, hence |e| <= ½ M τ². The same holds backward in time, with |τ|.
// - ε_p and ε_v, the errors of the state. The true state is p + e_p and v + e_v with |e_p| <= ε_p
//   and |e_v| <= ε_v, so the centre is off by |e_p + e_v τ| <= ε_p + ε_v |τ|.
// - κ, the clock skew. The stamp is off by some θ with |θ| <= κ: the state held at stamp + θ.
//   Uniform motion from there is off by |v θ| <= |v| κ, and errors and accelerations have had |τ −
//   θ| <= σ to work. So σ replaces |τ| in all other terms.
// - h, the time step of the sender's integrator. Semi-implicit Euler sets v ← v + a_k h, then p ← p
//   + v h. After n steps e = Σ a_k h² (n − k) over k = 0 … n − 1, so |e| <= ½ M h² n (n + 1) = ½ M
//   τ (τ + h), which constant full thrust reaches. Backward from a state e <= ½ M τ (τ − h), which
//   the same term covers. Explicit Euler (p first, then v) is the same run backward: ½ M τ (τ − h)
//   forward and ½ M τ (τ + h) backward. Between two steps the motion counted is p + v s + ½ a s (s
//   + h) for s in [0, h], which meets the states at both ends: with τ = n h + s, |e| <= M (½ n (n +
//   1) h² + n h s + ½ s (s + h)) = ½ M τ (τ + h). A sender that draws straight lines between steps
//   deviates by up to M h² / 8 more and should declare that as part of ε_p.
//
// A declared direction d, with a·d >= 0 as long as it holds, halves the ball of deviations: e·d >=
// 0 and |e| <= R = ½ M σ (σ + h). The half ball reaches towards a unit vector x by R if x·d >= 0,
// else by its rim's R √(1 − (x·d)²); for the axes that is R √(d_y² + d_z²) and so on. d need not
// have the exact length 1: the code divides by its length. By our clock the direction may end κ
// early, so it counts until direction_until − κ; from then on the full ball counts.
//
// An expiry limits promises, not the bound; it is read by our clock.
#pragma once

#include "collision_core/motion/motion_state.h"
#include "collision_core/numeric/moving_ball.h"

namespace collision::motion {

/// Everything that agent A can reach while |acceleration| <= M, given its state at `state.stamp`:
/// in space-time a parabolic horn. With τ = t − stamp and σ = |τ| + κ all of A lies in the ball
///
///   centre c(t) = p_WA + v_WA τ,   radius ρ(t) = r + u(t),
///   u(t) = ε_p + |v_WA| κ + ε_v σ + ½ M σ (σ + h).
///
/// It holds forward (τ >= 0) up to the next discontinuity, and backward (τ <= 0) down to the last
/// one. The terms are derived at the head of this file. World frame W, SI units. Source: Hubbard,
/// "Collision detection for interactive graphics applications", IEEE TVCG 1(3), 1995, section 3.
struct SpaceTimeBound {
  MotionState state;
  MotionLimits limits;
  double skew = 0;  ///< κ [s], >= 0: the sender's clock is off by at most this.
};

/// Whether the agent certainly stays where it is: it is at rest, and it cannot accelerate or its
/// speed cap is zero. Its position need not be known exactly. For two such agents no intersection
/// is reported, even if they overlap.
inline bool NeverMoves(const SpaceTimeBound& bound) {
  return bound.state.v_WA.isZero(0) && bound.state.velocity_error == 0 &&
         (bound.limits.acceleration_max == 0 || bound.limits.speed_max == 0);
}

/// The forward horn from `base` on: the ball of radius r + u(δ), anchored at p_WA. Requires base >=
/// state.stamp.
numeric::MovingBall ForwardBall(const SpaceTimeBound& bound, Instant base);

/// The backward horn from `base` on, valid while base + δ <= state.stamp. Requires base <=
/// state.stamp.
numeric::MovingBall BackwardBall(const SpaceTimeBound& bound, Instant base);

/// The part ½ M σ (σ + h) of u alone [m], which a declared direction makes smaller. Requires base
/// >= state.stamp.
numeric::Quadratic ForwardDeviation(const SpaceTimeBound& bound, Instant base);

/// The rest of u [m]: errors and skew. Requires base >= state.stamp.
numeric::Quadratic ForwardErrors(const SpaceTimeBound& bound, Instant base);

/// How far the deviation reaches along each axis while the declared direction d holds, as a
/// fraction of ½ M σ(σ + h): towards +x it is 1 if d_x >= 0, else √(d_y² + d_z²); towards −x as if
/// d were −d.
struct DirectionalReach {
  numeric::Interval upward[3] = {1, 1, 1};
  numeric::Interval downward[3] = {1, 1, 1};
};

/// The reach of the declared direction along each axis; all ones if none is declared.
DirectionalReach ReachOfDirection(const MotionState& state);

/// Seconds after `base` up to which the declared direction certainly holds (it may end κ early by
/// our clock). Negative if it does not hold at `base`, +infinity if it never ends.
double DirectionHoldsFor(const SpaceTimeBound& bound, Instant base);

}  // namespace collision::motion
