#include "server/bus/system_clock.h"

namespace collision::server {
namespace {

template <typename Duration>
std::int64_t Nanoseconds(Duration duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

}  // namespace

ClockReading SystemClock::Read() {
  return {.wall_ns = Nanoseconds(std::chrono::system_clock::now().time_since_epoch()),
          .monotonic_ns = Nanoseconds(std::chrono::steady_clock::now() - start_)};
}

}  // namespace collision::server
