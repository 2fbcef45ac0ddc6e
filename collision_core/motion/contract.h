// Does a new state honour what the last one declared?
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision::motion {

/// The result of comparing a new state with the bound of the state before it.
enum class ContractVerdict {
  /// The new horn lies inside the old one grown by the returned drifts, each at most twice the
  /// rounding allowance below.
  kKept,
  /// The new state could follow from the old, but its errors, direction or expiry promise less.
  kWidened,
  kBreached,  ///< No motion under the declared bound leads from the old state to the new.
};

/// The verdict, by how much a breach exceeds the bounds (certified: at least that much), and how
/// much room the new bound takes beyond the old one because of rounding.
struct ContractCheck {
  ContractVerdict verdict = ContractVerdict::kKept;
  /// How far the position lies outside, at least [m]; 0 unless breached.
  double position_excess = 0;
  double velocity_excess = 0;          ///< The same for the velocity [m/s].
  double acceleration_excess = 0;      ///< The same for the known acceleration [m/s²].
  double rotation_excess = 0;          ///< The same for the orientation, an angle [rad].
  double angular_velocity_excess = 0;  ///< The same for the angular velocity [rad/s].
  /// A lower bound on how far apart, at some instant between the two states, the old state's
  /// forward ball and the new state's backward ball of the reference point are [m] (GapBetween());
  /// 0 unless breached.
  double between_excess = 0;
  /// What rounding may have cost: the new horn lies inside the old one grown by
  /// `position_drift + velocity_drift τ' + ½ acceleration_drift τ'²` with τ' counted from the new
  /// stamp. 0 where it is certified inside.
  double position_drift = 0;
  double velocity_drift = 0;
  double acceleration_drift = 0;
  /// The same for the bound on the orientation: [rad] and [rad/s].
  double rotation_drift = 0;
  double angular_velocity_drift = 0;
};

/// Whether a contract check looks at an agent's orientation: that of a plain ball does not matter.
enum class OrientationUse { kMatters, kIgnored };

/// Compares `next` with the bound of the state before it. With s = next.stamp − before.state.stamp:
///
///   |p' − p − v s − ½ a s²| <= ½ D s (s + h) + ⅙ J s (s² + 3 h s + 3 h²) + errors,
///   |v' − v − a s| <= D s + ½ J s (s + h) + errors   and   |a' − a| <= 2 D + J s + errors.
///
/// (The last: at the new stamp the true acceleration is within D + J s of a, and within D of a'.) A
/// check of the position alone would accept any velocity, and both together still accept a
/// velocity with which the agent cannot have come from there. So at every instant between the two
/// states the forward ball of the one and the backward ball of the other, both about the reference
/// point and without the agent's radius, must have a point in common (contract_between.h). Under a
/// speed cap V also |v'| <= V, and p' must lie in the old capped ball and box (speed_cap.h). Where
/// the orientation matters and α is declared, the rotation is checked too, with Φ the angle between
/// two orientations:
///
///   Φ(q', exp(ω s) q) <= ½ α s (s + h) + errors   and   |ω' − ω| <= α s + errors.
///
/// Requires next.stamp >= before.state.stamp. Unchecked: before.limits hold for both states. O(1),
/// allocates nothing.
///
/// Why this keeps standing answers valid. The new horn is inside the old one if for all τ' >= 0,
/// with e_p = p' − p − v s − ½ a s², e_v = v' − v − a s and e_a = a' − a,
///
///   |e_p + e_v τ' + ½ e_a τ'²| + u'(τ') <= u(s + τ').
///
/// Both sides have the same cubic term, so it is enough to compare the coefficients of 1, τ' and
/// τ'². With m = κ + h, written out so that what both sides share cancels:
///
///   |e_p| <= ε_p − ε_p' + (|v| − |v'|) κ + ε_v (s + κ) − ε_v' κ + ½ D s (s + 2 κ + h)
///            + ⅙ J s (s² + 3 s m + 3 m²) + (κ + ½ h) (|a| s + (|a| − |a'|) κ)
///   |e_v| <= ε_v − ε_v' + D s + ½ J s (s + 2 m) + (κ + ½ h) (|a| − |a'|)
///   |e_a| <= J s
///
/// So a sender whose guess of a is wrong by more than has aged is *widened*: its estimate of what
/// it does not know points elsewhere. Where D bounds how wrong the guesses are, declare J no less
/// than twice D over the time between two states and they are kept. Then the state is *kept*. If
/// errors and skew (of both stamps: 2 κ) still explain it, it is *widened*, else *breached*. A
/// motion against a direction that held all the way is a breach; a half ball of e_p and one of e_v
/// add up to the half ball of the old horn, so a kept state's box lies inside the old box too. For
/// rotations, with Φ_e the angle from the prediction to q', the conditions are
///
///   Φ_e <= ε_R − ε_R' + (|ω| − |ω'|) κ + ½ α s (s + 2 κ + h)   and   |ω' − ω| <= α s.
///
/// States with ε_p > 0 are often *widened*: a new estimate may be off the old centre by both
/// errors.
///
/// Rounding allowance. The sums of an honest integrator are off by up to a unit in the last place
/// of p a step, which rounds twice; over at most 1000 steps between two states that is 1000 · 2^-52
/// |p|, likewise for v, and the error of v moves p for s. A stamp in whole nanoseconds is off by
/// half of one, so s by up to 1 ns: |v| · 1 ns and A · 1 ns, A the greatest acceleration; of a
/// itself a unit in the last place a step, and J · 1 ns. For the angle it is 1000 · 2^-49 rad (the
/// exponential and the product of each step), the error of ω for s, and |ω| · 1 ns. What is
/// actually used is returned as drift: the published bounds must leave that much room.
ContractCheck CheckContract(const SpaceTimeBound& before, const MotionState& next,
                            OrientationUse orientation = OrientationUse::kMatters);

}  // namespace collision::motion
