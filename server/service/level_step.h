// The part of a step that is about levels.
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

}  // namespace collision::server
