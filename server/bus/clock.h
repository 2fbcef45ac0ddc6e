// The daemon's own clocks.
#pragma once

#include <cstdint>

namespace collision::server {

/// Two readings of one moment. The world's time follows the monotonic one.
struct ClockReading {
  std::int64_t wall_ns = 0;       ///< Since 1970 (POSIX).
  std::int64_t monotonic_ns = 0;  ///< Since the clock was made.
};

/// Read once per step, on the daemon's thread.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual ClockReading Read() = 0;
};

}  // namespace collision::server
