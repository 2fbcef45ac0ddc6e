// The command line of collisiond.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace collision::server {

/// As sysexits.h has them, where it has one.
enum ExitCode {
  kExitOk = 0,
  kExitUsage = 2,           ///< The command line is wrong.
  kExitUnavailable = 69,    ///< DDS is not to be had.
  kExitRecording = 74,      ///< A recording cannot be written, or not be read to its end.
  kExitConfiguration = 78,  ///< The configuration is wrong.
};

struct Options {
  std::string config_file;  ///< Empty: the defaults.
  bool check_config = false;
  bool print_config = false;
  bool calibrate = false;
  std::optional<std::uint32_t> domain;   ///< Over the configuration's.
  std::optional<std::string> log_level;  ///< Likewise.
  std::string record_file;               ///< Empty: nothing is recorded.
  std::string replay_file;               ///< Empty: the daemon serves.
};

struct OptionsResult {
  std::optional<Options> options;  ///< Nothing: the program ends with `exit_code`.
  int exit_code = kExitOk;
  std::string output;  ///< For standard output: help, version.
  std::string error;   ///< For standard error.
};

OptionsResult ParseOptions(int argc, const char* const* argv);

}  // namespace collision::server
