// When the boxes of two agents first overlap.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// Do the boxes say more than the balls from `base` on? Only with a direction or a speed cap.
bool BoxesMatter(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant base);

/// The later of `time` and the first overlap, in seconds after `base`, of the boxes of the two horns
/// (parabolic faces, made smaller by direction and speed cap, and with `margin` between them),
/// rounded down; it may be +infinity.
/// Nothing later than `limit` is looked for.
double LaterOfBoxes(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant base, double margin,
                    double time, double limit);

}  // namespace collision
