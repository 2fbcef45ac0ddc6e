// What this process has used of the machine.
#pragma once

#include <cstdint>
#include <string>

namespace collision::server {

/// Since the start of the process.
struct ProcessUsage {
  std::uint64_t cpu_us = 0;        ///< Of all threads together.
  std::uint64_t memory_bytes = 0;  ///< Resident; 0: the system does not say.
};

/// The time that work takes, and what the process has used, for the status. Nothing that the
/// service answers depends on it: a replay, and most tests, have none. Any thread.
class ProcessMeter {
 public:
  /// When the service began is now.
  ProcessMeter();

  std::int64_t started_ns() const { return started_ns_; }  ///< Wall clock, since 1970.
  std::int64_t uptime_ns() const;  ///< Since started_ns(), also while the machine slept.

  /// For the length of a step: it does not go on while the machine sleeps. Some 25 ns a call.
  static std::int64_t NowNs();

  ProcessUsage Usage() const;

 private:
  std::int64_t started_ns_, boot_ns_;
};

/// "GCC 12.2.0, checks off": what made this program, for people.
std::string BuildText();

}  // namespace collision::server
