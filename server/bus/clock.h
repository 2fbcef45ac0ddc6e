// The daemon's own clocks.
#pragma once

#include <cstdint>

namespace collision::server {

/// Two readings of one moment.
struct ClockReading {
  std::int64_t wall_ns = 0;  ///< Since 1970 (POSIX). It may be set, forward and back.
  /// Since the clock was made. It never goes back, and goes on while the machine sleeps.
  std::int64_t monotonic_ns = 0;
  /// The system said that the wall clock was set since the last reading, by whatever amount. It may
  /// say so, too, after the machine has slept.
  bool wall_was_set = false;
};

/// Read once per step, on the daemon's thread.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual ClockReading Read() = 0;
};

}  // namespace collision::server
