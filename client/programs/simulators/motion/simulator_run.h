// What all simulators do around their motion: options, connection, log, report.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/motion_log.h"

namespace collision::client {

/// --seconds, which is required, and the options that all simulators share.
void AddRunOptions(CLI::App* app, SimulatorOptions* options);

/// Connects, lets `move` play the run, then closes the motion log, reports the traffic and throws
/// RefusedError if the service refused something. Returns kExitOk.
int RunSimulator(const SimulatorOptions& options,
                 const std::function<void(Pace* pace, MotionLog* log)>& move);

}  // namespace collision::client
