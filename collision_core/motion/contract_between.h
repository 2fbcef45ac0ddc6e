// Can one motion lead from one state to the next? The part of the contract between two states.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision::motion {

/// A lower bound [m] on how far apart two balls of the *reference point* are at some instant
/// between the two states: the forward one of `before`, of radius u(s), and the backward one of
/// `next`, of radius u(T − s). Neither includes the agent's radius. 0 unless they are proved to be
/// apart. The reference point of an agent that honours its declaration lies in both, so anything
/// above 0, beyond the sender's rounding, is a breach. With T = next.stamp − before.state.stamp, it
/// bounds
///
///   max over s in [0, T] of |Δ(s)| − R(s),   R(s) = u(s) + u'(T − s),
///   Δ(s) = p + v s + ½ a s² − p' + v' (T − s) − ½ a' (T − s)².
///
/// Without errors and jerk R is ½ D s² + ½ D (T − s)².
///
/// Derivation. Δ(s) is the offset of the forward ball's centre from the backward ball's. For a true
/// motion without a known part −Δ(s) = ∫ (s − t) x″ dt, so |Δ(s)| <= D ∫ |s − t| dt = ½ D s² + ½ D
/// (T − s)², the sum of both radii; with errors, skew, step, known accelerations and jerk both
/// horns hold as they are. s = T is the check of the position, s = 0 the same backward in time,
/// and s → ∞ that of the velocity. Together these are the bounds of λ · ∫ (s − t) x″ dt for every
/// vector λ: along one line a motion exists if and only if the result is 0 and |v' − v| <= D T;
/// across it, where thrust may turn, the check leaves a little more than can be reached. Only 0 <=
/// s <= T is searched: with the velocity's bound the rest follows.
///
/// Which s is tested comes from plain doubles; that the balls are apart there is proved in
/// intervals, beyond the rounding allowance of p' and, for T, of v' (contract.h).
///
/// Requires next.stamp >= before.state.stamp. Unchecked: before.limits and before.skew hold for
/// both states. Honest states are mostly decided by a quick test in plain doubles. Allocates
/// nothing.
double GapBetween(const SpaceTimeBound& before, const MotionState& next);

}  // namespace collision::motion
