// What happens to a pair if both keep the motion that they told.
#pragma once

#include <optional>

#include "collision_core/base/work_budget.h"
#include "collision_core/detection/agents/history.h"
#include "collision_core/detection/events/collision_event.h"

namespace collision::detection {

/// What is expected of the two from `from` on, for `ahead` seconds at most: their newest states
/// taken as exact, with the acceleration and the angular velocity that these tell and nothing else.
/// Nothing while a shape is awaited, and where an agent has expired by then. `from` counts from the
/// newer of the two states on.
std::optional<Expectation> ExpectationOf(const History& a, const History& b, Instant from,
                                         double ahead, WorkBudget* work);

}  // namespace collision::detection
