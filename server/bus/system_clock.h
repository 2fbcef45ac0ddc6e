// The clocks of the operating system.
#pragma once

#include <cstdint>
#include <optional>

#include "server/bus/clock.h"

namespace collision::server {

/// CLOCK_REALTIME, and CLOCK_BOOTTIME, which goes on while the machine sleeps; both are slewed
/// alike, so that they differ by more or less only when the wall clock is set.
///
/// The kernel tells of each time that the wall clock is set, by a timer that it cancels. Without
/// such a timer (no room for another file) `wall_was_set` stays false. One thread.
class SystemClock final : public Clock {
 public:
  SystemClock();
  ~SystemClock() override;
  SystemClock(const SystemClock&) = delete;
  SystemClock& operator=(const SystemClock&) = delete;

  ClockReading Read() override;

 private:
  bool TakeCancellation();
  void ArmTimer();

  std::int64_t start_ns_ = 0;
  int timer_ = -1;
};

/// Whether the kernel counts the wall clock as synchronised; nullopt where it may not be asked
/// (systemd's ProtectClock=).
std::optional<bool> WallClockIsSynchronised();

}  // namespace collision::server
