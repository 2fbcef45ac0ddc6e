// The options and exit codes that the simulators share.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <stdexcept>

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

/// Runs a program's `run`; what it throws is told with the program's name, and becomes its exit code:
/// RefusedError kExitRefused, BadInput kExitBadData, all else kExitUnavailable.
int RunProgram(const char* program, const std::function<int()>& run);

/// Thrown where what the user gave is of no use.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses; std::nullopt: go on, else the exit code (0 after --help, 2 for a wrong option).
std::optional<int> ParseCommandLine(CLI::App* app, int argc, char** argv);

}  // namespace collision::client
