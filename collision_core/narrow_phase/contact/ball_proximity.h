// Two balls at one instant: distance, point and normal as an event reports them.
#pragma once

#include "collision_core/narrow_phase/contact/ball_contact.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::narrow_phase {

/// Two balls at δ seconds after the base of the segments. The normal lies along the centres, the
/// point half-way between the surfaces.
Proximity BallProximity(const BallSegment& a, const BallSegment& b, double delta);

}  // namespace collision::narrow_phase
