// What the configuration means to the detectors.
#pragma once

#include <cstddef>

#include "collision_core/detection/step/detector_options.h"
#include "idl/config.pb.h"

namespace collision::server {

/// Time slices in each temporal resolution of a wall clock, for a simulator whose pairs want more
/// than the budget of a step: others wait for a slice of it, not for all of it. In simulated time
/// steps are not short, and nobody waits for them by a clock.
inline constexpr int kSlicesPerResolution = 32;

/// Where levels are configured, they may spend this part of the step's budget, the same each. The
/// detector of contacts has the rest.
inline constexpr double kLevelsShare = 0.25;

/// Beside the budget of a step, what hypothetical agents may use for their screening, as a part of
/// it: the detectors of real agents have no less because of them.
inline constexpr double kScreeningShare = 0.25;

/// Of the detector of contacts, beside those of `level_detectors`. Requires a complete
/// configuration.
detection::DetectorOptions DetectorOptionsOf(const v1::Config& config, std::size_t level_detectors);

/// Of one of the `level_detectors` of levels, which is at least 1: one that announces what may
/// begin within `look_ahead` [s].
detection::DetectorOptions LevelDetectorOptions(const v1::Config& config,
                                                std::size_t level_detectors, double look_ahead);

/// Of the detector of hypothetical agents.
detection::DetectorOptions ScreeningDetectorOptions(const v1::Config& config);

}  // namespace collision::server
