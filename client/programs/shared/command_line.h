// The options that the simulators share.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>

#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/pace.h"

namespace collision::client {

/// The DDS domains that there are (idl/limits.h).
CLI::Range DomainRange();

/// Adds --world and --domain, which may be set for all programs by COLLISION_WORLD and
/// COLLISION_DOMAIN.
void AddWorldOptions(CLI::App* app, const std::string& purpose, std::string* world,
                     std::uint32_t* domain);

/// Adds --world, --simulator, --domain, --lock-step, --real-time, ... to the command line.
void AddSimulatorOptions(CLI::App* app, SimulatorOptions* options);

/// A finite number in (0, greatest], or in [0, greatest] if `zero`. CLI::Range lets NaN pass.
CLI::Validator Finite(double greatest, bool zero);

/// Longest run of a simulator, three years [s].
inline constexpr double kRunSecondsMax = 1e8;

/// Calls `run`. Prints an exception with the program's name and turns it into an exit code:
/// RefusedError kExitRefused, BadInput kExitBadData, any other kExitUnavailable.
int RunProgram(const char* program, const std::function<int()>& run);

/// Parses the command line. Returns the exit code if the program ends here (0 after --help, 2 for a
/// wrong option), else nullopt.
std::optional<int> ParseCommandLine(CLI::App* app, int argc, char** argv);

}  // namespace collision::client
