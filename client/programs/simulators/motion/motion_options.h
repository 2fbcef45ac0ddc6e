// The options of a simulated motion, which several simulators share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>

#include "client/programs/simulators/motion/rigid_motion.h"

namespace collision::client {

/// Adds --speed-max [m/s] and --acceleration-max [m/s2].
void AddSpeedOptions(CLI::App* app, double* speed_max_m_s, double* acceleration_max_m_s2);

/// Adds --angular-acceleration-max [rad/s2] and --turn-max [rad/s].
void AddTurnOptions(CLI::App* app, TurnLimits* limits);

/// Adds --rate, the steps per second, and --state-every, the steps between two states.
void AddStepOptions(CLI::App* app, double* rate_hz, std::size_t* state_every);

}  // namespace collision::client
