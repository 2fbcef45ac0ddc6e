#include "server/service/wait_for_clock.h"

namespace collision::server {

ClockWait WaitForClock(std::chrono::nanoseconds longest,
                       const std::function<std::optional<bool>()>& is_synchronised,
                       const std::function<bool(std::chrono::nanoseconds)>& pause) {
  for (std::chrono::nanoseconds waited{0};; waited += kClockQueryPeriod) {
    const std::optional<bool> synchronised = is_synchronised();
    if (!synchronised) return ClockWait::kNotToldBySystem;
    if (*synchronised) return ClockWait::kSynchronised;
    if (waited >= longest) return ClockWait::kTimeout;
    if (!pause(kClockQueryPeriod)) return ClockWait::kStopped;
  }
}

}  // namespace collision::server
