// A scene to look at, again and again.
#pragma once

#include <cstdint>

#include "client/programs/scene_runner/runner.h"

namespace collision::client {

/// Starts the gateway, prints its address, and runs the scene at the pace of the wall clock (or as
/// `--speed` among the arguments of simulators says) until the program is told to stop; the checker
/// is not asked. Throws std::runtime_error if the gateway or the scene cannot be run.
RunResult ViewScene(RunnerOptions options, std::uint16_t port);

}  // namespace collision::client
