// When the balls of two agents first overlap, with speed caps.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// The later of `time`, when the balls of the two horns first overlap, and the first overlaps of the
/// capped balls (speed_cap.h): each agent's horn or capped ball against each of the other's. Radii
/// are together larger by `margin`. In seconds after `base`, rounded down; +infinity: one of them
/// never overlaps up to `limit`. Without a cap, or before it takes over, it is `time`.
double LaterOfCappedBalls(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant base,
                          double margin, double time, double limit);

}  // namespace collision
