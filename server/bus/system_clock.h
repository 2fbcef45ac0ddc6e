// The clocks of the operating system.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>

#include "server/bus/clock.h"

namespace collision::server {

/// CLOCK_REALTIME, and CLOCK_BOOTTIME, which goes on while the machine sleeps; both are slewed
/// alike, so that they differ by more or less only when the wall clock is set.
///
/// The kernel tells of each time that the wall clock is set, by a timer that it cancels; a thread
/// waits for that. Without such a timer (no room for another file) `wall_was_set` stays false. One
/// thread calls Read().
class SystemClock final : public Clock {
 public:
  /// `on_set` is called, on a thread of its own, when the wall clock was set: waits that end at a
  /// time of that clock, as those of DDS do, would otherwise last longer by as much as it was set
  /// back.
  explicit SystemClock(std::function<void()> on_set = {});
  ~SystemClock() override;
  SystemClock(const SystemClock&) = delete;
  SystemClock& operator=(const SystemClock&) = delete;

  ClockReading Read() override;

 private:
  bool TakeCancellation();
  void ArmTimer();
  void Watch();

  const std::function<void()> on_set_;
  const std::int64_t start_ns_;
  const int timer_;
  const int end_;  ///< Readable: the thread is to end.
  std::atomic<bool> was_set_ = false;
  std::thread watch_;
};

/// Whether the kernel counts the wall clock as synchronised; nullopt where it may not be asked
/// (systemd's ProtectClock=).
std::optional<bool> WallClockIsSynchronised();

}  // namespace collision::server
