// The part of a step behind the contacts: levels, and the screening of hypothetical agents.
#pragma once

#include <functional>

#include "server/detectors/detectors.h"
#include "server/publish/publisher.h"
#include "server/world/world.h"

namespace collision::server {

/// Brings the levels to the world's time and publishes what they found. After the contacts of the
/// step, and before its grants.
void StepLevels(const std::function<void()>& progress, Detectors* detectors, World* world,
                Publisher* publisher);

/// Likewise of hypothetical agents. Nothing but their own clearances depends on it.
void StepScreening(const std::function<void()>& progress, Detectors* detectors, World* world,
                   Publisher* publisher);

}  // namespace collision::server
