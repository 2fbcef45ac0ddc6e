// How near two agents are at one instant of their histories.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/detection/agents/history.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::detection {

/// Separation, depth, contact point and normal of the two at one instant.
narrow_phase::Proximity ProximityAt(const History& a, const History& b, Instant at,
                                    WorkBudget* work);

/// What the proximity of the two balls says where a shape is awaited: only the ball is known, which
/// can exclude a contact, but neither confirms one nor bounds the separation from above.
narrow_phase::Proximity ProximityOfAwaited(narrow_phase::Proximity of_balls);

}  // namespace collision::detection
