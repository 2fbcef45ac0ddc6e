// The clocks of the operating system.
#pragma once

#include <chrono>

#include "server/bus/clock.h"

namespace collision::server {

/// Wall clock and steady clock.
class SystemClock final : public Clock {
 public:
  ClockReading Read() override;

 private:
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace collision::server
