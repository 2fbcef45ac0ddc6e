// The options and exit codes that the simulators share.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "client/simulators/pace.h"

namespace collision::client {

/// sysexits(3).
enum ExitCode {
  kExitOk = 0,
  kExitRefused = 1,  ///< The service refused the agents.
  kExitUsage = 2,
  kExitBadData = 65,
  kExitNoInput = 66,
  kExitUnavailable = 69
};

/// Adds --world, --simulator, --domain, --lock-step, --real-time, ... to the command line.
void AddSimulatorOptions(CLI::App* app, SimulatorOptions* options);

/// A finite number in (0, greatest], or in [0, greatest] if `zero`. CLI::Range and its like let
/// what is not a number pass.
CLI::Validator Finite(double greatest, bool zero);

/// The longest run of a simulator, three years [s].
inline constexpr double kRunSecondsMax = 1e8;

/// Parses; std::nullopt: go on, else the exit code (0 after --help, 2 for a wrong option).
std::optional<int> ParseCommandLine(CLI::App* app, int argc, char** argv);

}  // namespace collision::client
