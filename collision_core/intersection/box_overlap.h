// When the boxes of two agents first overlap.
#pragma once

#include "collision_core/intersection/bound_pair.h"

namespace collision::intersection {

/// Whether the boxes can be apart where the balls overlap, at or after the base: only with a
/// direction or a speed cap.
bool BoxesMatter(const BoundPair& pair);

/// The later of `time` and the first overlap of the boxes of the two horns (curved faces, made
/// smaller by direction and speed cap, and with the pair's margin between them), in seconds after
/// the base, rounded down; it may be +infinity. Nothing later than `limit` is searched.
///
/// The boxes overlap when six functions of time are all >= 0. Each is a cubic in pieces (up to the
/// speed cap of either agent, and from there on). Without known accelerations it is convex, so it
/// fails on one interval of time at most: six rounds find the end of the last failure. Pieces end
/// where a direction ends.
double LaterOfBoxes(const BoundPair& pair, double time, double limit);

}  // namespace collision::intersection
