// When the balls of two agents first overlap, with speed caps.
#pragma once

#include "collision_core/intersection/bound_pair.h"

namespace collision::intersection {

/// The later of `time`, when the balls of the two horns first overlap, and the first overlaps of
/// the capped balls (speed_cap.h): each agent's horn or capped ball against each of the other's,
/// four pairs in all. Each pair is apart until its own first overlap, so the latest counts. In
/// seconds after the pair's base, rounded down; +infinity: one of the four never overlaps up to
/// `limit`. Without a cap, or before it takes over, the result is `time`.
double LaterOfCappedBalls(const BoundPair& pair, double time, double limit);

}  // namespace collision::intersection
