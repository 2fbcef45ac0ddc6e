// What the configuration means to the detector.
#pragma once

#include "collision_core/detection/step/detector_options.h"
#include "idl/config.pb.h"

namespace collision::server {

/// Requires a complete configuration.
detection::DetectorOptions DetectorOptionsOf(const v1::Config& config);

}  // namespace collision::server
