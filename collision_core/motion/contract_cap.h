// The part of the contract that a speed cap adds.
#pragma once

#include "collision_core/motion/speed_cap.h"

namespace collision::motion {

/// The result of comparing a new state with the speed cap of the bound before it, without any
/// allowance for rounding.
struct CapCheck {
  double position_excess =
      0;  ///< A lower bound on how far the position lies beyond what the cap allows [m].
  double velocity_excess = 0;  ///< The speed exceeds the cap, at least by this [m/s].
  /// The new capped ball and box lie inside the old ones grown by this [m].
  double position_drift = 0;
};

/// Checks speed, position and nesting as derived in speed_cap.h. Requires a cap and next.stamp >=
/// before.state.stamp. O(1), allocates nothing.
CapCheck CheckCap(const SpaceTimeBound& before, const MotionState& next);

}  // namespace collision::motion
