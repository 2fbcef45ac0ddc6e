// Does a new state honour what the last one promised?
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision {

enum class ContractVerdict {
  kKept,      ///< The new horn lies inside the old one, up to the rounding allowance below.
  kWidened,   ///< The new state could follow from the old, but its errors, direction, rotation
              ///< error or expiry promise less.
  kBreached,  ///< No motion under the declared bound leads from the old state to the new.
};

struct ContractCheck {
  ContractVerdict verdict = ContractVerdict::kKept;
  double position_excess =
      0;  ///< How far the position lies outside, at least [m]; 0 unless breached.
  double velocity_excess = 0;          ///< Likewise for the velocity [m/s].
  double rotation_excess = 0;          ///< Likewise for the orientation, as an angle [rad].
  double angular_velocity_excess = 0;  ///< Likewise for the angular velocity [rad/s].
  /// How far apart the old state's forward ball and the new one's backward ball are at some instant
  /// between the two, at least [m]; 0 unless breached.
  double between_excess = 0;
  /// What rounding may have cost: the new horn lies inside the old one grown by
  /// `position_drift + velocity_drift * τ'` with τ' counted from the new stamp. 0 where it is
  /// certified inside.
  double position_drift = 0;
  double velocity_drift = 0;
  /// Likewise for the bound on the orientation: [rad] and [rad/s].
  double rotation_drift = 0;
  double angular_velocity_drift = 0;
};

/// Compares `next` with the bound before it (same declaration, next.stamp >= before.state.stamp),
/// with s = next.stamp − before.stamp:
///   |p' − c(t0')| <= ½ M s (s + h) + errors  and  |v' − v| <= M s + errors.
/// A position check alone would let an agent arrive with any velocity; and both together a velocity
/// with which it cannot have come from there, so at every instant between the two the forward ball
/// of the one and the backward ball of the other must have a point in common
/// (contract_between.h). Under a speed cap V also
/// |v'| <= V, and p' in the old capped ball and box (speed_cap.h); the declaration and with it the
/// cap must be the same. For an agent that has a shape
/// (or will have) and declares α, with Φ the angle between two orientations, likewise
///   Φ(q', exp(ω s) q) <= ½ α s (s + h) + errors  and  |ω' − ω| <= α s + errors;
/// of a ball the rotation is not looked at. O(1), allocates nothing.
ContractCheck CheckContract(const SpaceTimeBound& before, const MotionState& next);

}  // namespace collision
