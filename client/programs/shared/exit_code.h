// The exit codes that the programs share, and the exception that stands for one of them.
#pragma once

#include <stdexcept>

namespace collision::client {

/// sysexits(3).
enum ExitCode {
  kExitOk = 0,
  kExitRefused = 1,  ///< The service refused the agents or the command, or has not answered it.
  kExitUsage = 2,
  kExitBadData = 65,
  kExitNoInput = 66,
  kExitUnavailable = 69,
  kExitOutputFailed = 74
};

/// The service refused this simulator's agents, and repeating them does not help. RunProgram()
/// turns it into kExitRefused.
class RefusedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown for input of the user that cannot be used. RunProgram() turns it into kExitBadData.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace collision::client
