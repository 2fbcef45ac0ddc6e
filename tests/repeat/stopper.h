// Stops processes and lets them go on, at random times.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/random.h"

namespace collision::repeat {

/// The processes whose ids are names of files in a folder. Each stop is much shorter than any lease
/// of the service. The destructor lets all go on.
class Stopper {
 public:
  Stopper(std::string folder, std::uint64_t seed);
  Stopper(const Stopper&) = delete;
  Stopper& operator=(const Stopper&) = delete;
  ~Stopper();

  /// Stops a process, or lets the stopped one go on. Returns how long to wait until the next call.
  std::chrono::nanoseconds Turn();

  /// Lets the stopped process go on.
  void GoOn();

  int stops() const { return stops_; }

 private:
  void FindProcesses();

  std::string folder_;
  Random random_;
  std::map<pid_t, int> processes_;  ///< Descriptors: an id may have been given to another process.
  std::optional<int> stopped_;      ///< Of the descriptors.
  int stops_ = 0;
};

}  // namespace collision::repeat
