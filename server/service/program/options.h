// The command line of collisiond.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/service/exit_code.h"

namespace collision::server {

struct Options {
  std::string config_file;  ///< Empty: the defaults.
  bool check_config = false;
  bool print_config = false;
  bool calibrate = false;
  std::optional<std::int32_t> reload;  ///< The process of a service that is to reload.
  /// These go before the configuration's; from the environment if the command line is silent.
  std::optional<std::string> world;
  std::optional<std::uint32_t> domain;
  std::optional<std::string> credentials;
  std::optional<std::string> log_level;
  std::string record_file;  ///< Empty: nothing is recorded.
  std::string replay_file;  ///< Or a folder of segments; empty: the daemon serves.
  std::optional<std::int64_t> from_ns, until_ns;  ///< Of the replay: wall time.
  bool transcript = false;  ///< Of the replay: all messages, in place of events.
};

struct OptionsResult {
  std::optional<Options> options;  ///< nullopt: the program ends with `exit_code`.
  int exit_code = kExitOk;
  std::string output;  ///< For standard output: help, version.
  std::string error;   ///< For standard error.
};

/// Parses the command line; what is wrong, or asked for in the form of --help, is in the result.
OptionsResult ParseOptions(int argc, const char* const* argv);

}  // namespace collision::server
