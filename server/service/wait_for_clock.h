// Waiting until the wall clock is right before the service begins.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

namespace collision::server {

/// How often the system is asked.
inline constexpr std::chrono::milliseconds kClockQueryPeriod(100);

/// How the wait ended.
enum class ClockWait {
  kSynchronised,
  kNotToldBySystem,  ///< It may not be asked; nothing was waited for.
  kTimeout,
  kStopped
};

/// Asks `is_synchronised` (nullopt: the system does not say) every kClockQueryPeriod until it says
/// so, for `longest` at most. `pause` waits so long; false: the program is to stop.
ClockWait WaitForClock(std::chrono::nanoseconds longest,
                       const std::function<std::optional<bool>()>& is_synchronised,
                       const std::function<bool(std::chrono::nanoseconds)>& pause);

}  // namespace collision::server
