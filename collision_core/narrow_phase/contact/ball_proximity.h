// Two balls at one instant, as an event tells it.
#pragma once

#include "collision_core/narrow_phase/contact/ball_contact.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::narrow_phase {

/// At δ after the segments' base. The normal lies along the centres, the point half-way between the
/// surfaces.
Proximity BallProximity(const BallSegment& a, const BallSegment& b, double delta);

}  // namespace collision::narrow_phase
