// The narrow phase of a pair over a whole interval of time.
#pragma once

#include "collision_core/detection/contact_tracker.h"
#include "collision_core/detection/history.h"

namespace collision {

/// Judges everything from tracker->at() to `until`, stamp by stamp, with whatever the two histories
/// know. Returns the number of segments judged.
std::uint64_t Judge(const History& a, const History& b, Instant until, ContactTracker* tracker);

/// The two balls at one instant; what the event says of point, normal and depth.
SeparationAt SeparationOf(const History& a, const History& b, Instant at);

}  // namespace collision
