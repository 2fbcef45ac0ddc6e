// The options that the simulators share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/pace.h"

namespace collision::client {

/// The DDS domains that there are (idl/limits.h).
CLI::Validator DomainRange();

/// The name of a world or of a simulator (idl/limits.h).
CLI::Validator IdentifierWord();

/// Adds --world, --domain and --credentials, which may be set for all programs by COLLISION_WORLD,
/// COLLISION_DOMAIN and COLLISION_CREDENTIALS.
void AddWorldOptions(CLI::App* app, const std::string& purpose, std::string* world,
                     std::uint32_t* domain, std::string* credentials);

/// Adds --world, --simulator, --domain, --lock-step, --real-time, ... to the command line.
void AddSimulatorOptions(CLI::App* app, SimulatorOptions* options);

// Those of CLI11 have messages of their own, and its Range lets NaN pass. Here every option that is
// refused says "OPTION: VALUE, allowed: RANGE".

/// A finite number in (0, greatest], or in [0, greatest] if `zero`.
CLI::Validator Finite(double greatest, bool zero);

/// A number in [least, greatest].
CLI::Validator Between(double least, double greatest);

/// A whole number in [least, greatest].
CLI::Validator WholeBetween(std::int64_t least, std::int64_t greatest);

/// One of these words.
CLI::Validator OneOf(std::vector<std::string> words);

/// One of the words of `values`, in place of which their numbers are read.
template <typename Value>
CLI::Validator ValueOf(const std::map<std::string, Value>& values) {
  std::vector<std::string> words;
  std::map<std::string, std::string> numbers;
  for (const auto& [word, value] : values) {
    words.push_back(word);
    numbers[word] = std::to_string(static_cast<int>(value));
  }
  const CLI::Validator check = OneOf(words);
  const auto transform = [check, numbers](std::string& text) {
    const std::string refusal = check(text);
    if (refusal.empty()) text = numbers.at(text);
    return refusal;
  };
  return CLI::Validator(transform, check.get_description());
}

/// Longest run of a simulator, three years [s].
inline constexpr double kRunSecondsMax = 1e8;

/// Calls `run`. Prints an exception with the program's name and turns it into an exit code:
/// RefusedError kExitRefused, BadInput kExitBadData, any other kExitUnavailable.
int RunProgram(const char* program, const std::function<int()>& run);

/// Installed programs have other names than those of the build: help and version show the one by
/// which the program was called.
void NameAsCalled(CLI::App* app, const char* path);

/// Adds --version.
void AddVersion(CLI::App* app);

/// Parses the command line, with --version. Returns the exit code if the program ends here (0 after
/// --help, 2 for a wrong option), else nullopt.
std::optional<int> ParseCommandLine(CLI::App* app, int argc, char** argv);

}  // namespace collision::client
