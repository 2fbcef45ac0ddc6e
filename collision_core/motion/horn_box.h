// The axis-aligned box of a horn at one instant.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision::motion {

/// An axis-aligned box in W [m]; each face is an interval that contains the exact one.
struct FaceBox {
  numeric::Interval lower[3];
  numeric::Interval upper[3];
};

/// The box of the forward horn at t: the box of its ball, made smaller by the declared direction
/// where it holds and by the declared speed cap (speed_cap.h). Requires t >= state.stamp.
FaceBox BoxAt(const SpaceTimeBound& bound, Instant t);

/// Whether a declared direction makes a box smaller.
enum class DirectionUse { kIgnored, kCounted };

/// The same with the direction counted or ignored, whenever it ends.
FaceBox BoxAt(const SpaceTimeBound& bound, Instant t, DirectionUse direction);

}  // namespace collision::motion
