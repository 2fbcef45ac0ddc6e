// What the configuration means to the detector.
#pragma once

#include "collision_core/detection/step/detector_options.h"
#include "idl/config.pb.h"

namespace collision::server {

/// Time slices in each temporal resolution of a wall clock, for a simulator whose pairs want more
/// than the budget of a step: others wait for a slice of it, not for all of it. In simulated time
/// steps are not short, and nobody waits for them by a clock.
inline constexpr int kSlicesPerResolution = 32;

/// Requires a complete configuration.
detection::DetectorOptions DetectorOptionsOf(const v1::Config& config);

}  // namespace collision::server
