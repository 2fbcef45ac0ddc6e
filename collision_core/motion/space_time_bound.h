// Where an agent can be, given only one state.
//
// The bound is a ball that moves and grows. It is known at the stamp: position p, velocity v,
// acceleration a (zero, if none is known), and the radius r of a ball about the reference point
// that contains the agent in every orientation. With τ = t − stamp, all of the agent lies within r
// + u(t) of c(t) = p + v τ + ½ a τ². The term u(t) collects everything that is not known, with σ =
// |τ| + κ:
//
//   u(t) = ε_p + |v| κ + ε_v σ + ½ D σ (σ + h) + ⅙ J σ (σ² + 3 h σ + 3 h²) + |a| (κ + ½ h) σ
//
// - D + J |τ|, the bound on what is not known of the acceleration: |x″ − a| <= D + J |τ|. The
//   reference point deviates from the motion that is known by e(t) = ∫∫ (x″ − a), hence |e| <= ½ D
//   τ² + ⅙ J τ³. The same holds backward in time, with |τ|. With a = 0 and J = 0 this is Hubbard's
//   horn, and D is his M.
// - ε_p and ε_v, the errors of the state. The true state is p + e_p and v + e_v with |e_p| <= ε_p
//   and |e_v| <= ε_v, so the centre is off by |e_p + e_v τ| <= ε_p + ε_v |τ|.
// - κ, the clock skew. The stamp is off by some θ with |θ| <= κ: the state held at stamp + θ.
//   Uniform motion from there is off by |v θ| <= |v| κ, the bend by ½ |a| |τ² − (τ − θ)²| <= |a| κ
//   (|τ| + ½ κ) <= |a| κ σ, and errors and accelerations have had |τ − θ| <= σ to work. So σ
//   replaces
//   |τ| in all other terms.
// - h, the time step of the sender's integrator. Semi-implicit Euler sets v ← v + a_k h, then p ← p
//   + v h. After n steps e = Σ a_k h² (n − k) over k = 0 … n − 1, so |e| <= ½ D h² n (n + 1) = ½ D
//   τ (τ + h), which constant full thrust reaches. Backward from a state e <= ½ D τ (τ − h), which
//   the same term covers. Explicit Euler (p first, then v) is the same run backward: ½ D τ (τ − h)
//   forward and ½ D τ (τ + h) backward. Between two steps the motion counted is p + v s + ½ a s (s
//   + h) for s in [0, h], which meets the states at both ends: with τ = n h + s, |e| <= D (½ n (n +
//   1) h² + n h s + ½ s (s + h)) = ½ D τ (τ + h). The known a is stepped likewise, to ½ a τ (τ ±
//   h): off by ½ |a| h τ. Step k deviates by up to J (k + 1) h, so n steps by J h³ Σ (k + 1) (n −
//   k) = ⅙ J h³ n (n + 1) (n + 2); ⅙ J ((τ + h)³ − h³), the term above, is no less at τ = n h,
//   neither is its slope there less than J h² ½ (n + 1)² (with the ½ J (n + 1) h² that the next
//   step adds at once), nor its second derivative J (τ + h) than J (n + 1) h. A sender that draws
//   straight lines between steps deviates by up to (|a| + D + J τ) h² / 8 more and should declare
//   that as part of ε_p.
//
// A declared direction d, with (x″ − a)·d >= 0 as long as it holds, halves the ball of deviations:
// e·d >= 0 and |e| <= R = ½ D σ (σ + h) + ⅙ J σ (σ² + 3 h σ + 3 h²). The half ball reaches towards
// a unit vector x by R if x·d >= 0, else by its rim's R √(1 − (x·d)²); for the axes that is R
// √(d_y² + d_z²) and so on. d need not have the exact length 1: the code divides by its length. By
// our clock the direction may end κ early, so it counts until direction_until − κ; from then on
// the full ball counts.
//
// An expiry limits promises, not the bound; it is read by our clock.
#pragma once

#include "collision_core/motion/motion_state.h"
#include "collision_core/numeric/moving_ball.h"

namespace collision::motion {

/// Everything that agent A can reach while |acceleration − a_WA| <= D + J |τ|, given its state at
/// `state.stamp`: in space-time a horn. With τ = t − stamp and σ = |τ| + κ all of A lies in the
/// ball
///
///   centre c(t) = p_WA + v_WA τ + ½ a_WA τ²,   radius ρ(t) = r + u(t),
///   u(t) = ε_p + |v_WA| κ + ε_v σ + ½ D σ (σ + h) + ⅙ J σ (σ² + 3 h σ + 3 h²) + |a_WA| (κ + ½ h)
///   σ.
///
/// It holds forward (τ >= 0) up to the next discontinuity, and backward (τ <= 0) down to the last
/// one. The terms are derived at the head of this file. World frame W, SI units. Source: Hubbard,
/// "Collision detection for interactive graphics applications", IEEE TVCG 1(3), 1995, section 3.
struct SpaceTimeBound {
  MotionState state;
  MotionLimits limits;
  double skew = 0;  ///< κ [s], >= 0: the sender's clock is off by at most this.
};

/// Whether the agent can accelerate in a way that its owner does not know.
inline bool CanDeviate(const MotionLimits& limits) {
  return limits.acceleration_max > 0 || limits.jerk_max > 0;
}

/// Whether the agent certainly stays where it is: it is at rest, and it cannot accelerate or its
/// speed cap is zero. Its position need not be known exactly. For two such agents no intersection
/// is reported, even if they overlap.
inline bool NeverMoves(const SpaceTimeBound& bound) {
  const bool cannot_accelerate = !CanDeviate(bound.limits) && !HasKnownAcceleration(bound.state);
  return bound.state.v_WA.isZero(0) && bound.state.velocity_error == 0 &&
         (cannot_accelerate || bound.limits.speed_max == 0);
}

/// Whether the centre of the horn bends or its radius has a cubic term: then the pair routines use
/// their wider forms.
inline bool Bends(const SpaceTimeBound& bound) {
  return bound.limits.jerk_max > 0 || HasKnownAcceleration(bound.state);
}

/// The forward horn from `base` on: the ball of radius r + u(δ), anchored at p_WA. Requires base >=
/// state.stamp.
numeric::MovingBall ForwardBall(const SpaceTimeBound& bound, Instant base);

/// The backward horn from `base` on, valid while base + δ <= state.stamp. Requires base <=
/// state.stamp.
numeric::MovingBall BackwardBall(const SpaceTimeBound& bound, Instant base);

/// The part ½ D σ (σ + h) + ⅙ J σ (σ² + 3 h σ + 3 h²) of u alone [m], which a declared direction
/// makes smaller. Requires base >= state.stamp.
numeric::Cubic ForwardDeviation(const SpaceTimeBound& bound, Instant base);

/// The rest of u [m]: errors and skew. Requires base >= state.stamp.
numeric::Cubic ForwardErrors(const SpaceTimeBound& bound, Instant base);

/// How far the deviation reaches along each axis while the declared direction d holds, as a
/// fraction of ForwardDeviation(): towards +x it is 1 if d_x >= 0, else √(d_y² + d_z²); towards −x
/// as if d were −d.
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
