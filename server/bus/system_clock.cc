#include "server/bus/system_clock.h"

#include <sys/timerfd.h>
#include <sys/timex.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>

namespace collision::server {
namespace {

/// Another process may run between the readings of the two clocks: the closest of so many attempts
/// counts, and the first whose readings lie within kCloseNs.
constexpr int kAttempts = 8;
constexpr std::int64_t kCloseNs = 20'000;

std::int64_t Now(clockid_t clock) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * kNanosecondsPerSecond + time.tv_nsec;
}

struct Pair {
  std::int64_t wall_ns = 0;
  std::int64_t boot_ns = 0;
  std::int64_t between_ns = 0;  ///< Boot time that passed around the reading of the wall clock.
};

Pair ReadOnce() {
  const std::int64_t before_ns = Now(CLOCK_BOOTTIME);
  const std::int64_t wall_ns = Now(CLOCK_REALTIME);
  const std::int64_t after_ns = Now(CLOCK_BOOTTIME);
  return {wall_ns, before_ns + (after_ns - before_ns) / 2, after_ns - before_ns};
}

Pair ReadBoth() {
  Pair best = ReadOnce();
  for (int attempt = 1; attempt < kAttempts && best.between_ns > kCloseNs; ++attempt) {
    const Pair next = ReadOnce();
    if (next.between_ns < best.between_ns) best = next;
  }
  return best;
}

}  // namespace

SystemClock::SystemClock()
    : start_ns_(Now(CLOCK_BOOTTIME)),
      timer_(timerfd_create(CLOCK_REALTIME, TFD_NONBLOCK | TFD_CLOEXEC)) {
  ArmTimer();
}

SystemClock::~SystemClock() {
  if (timer_ >= 0) close(timer_);
}

/// The timer is never meant to fire, only to be cancelled.
void SystemClock::ArmTimer() {
  if (timer_ < 0) return;
  constexpr std::int64_t kFarSeconds = 1LL << 33;  // the year 2242
  itimerspec far{};
  far.it_value.tv_sec = kFarSeconds;
  // It fails with ECANCELED, and is armed all the same, if the clock has just been set.
  timerfd_settime(timer_, TFD_TIMER_ABSTIME | TFD_TIMER_CANCEL_ON_SET, &far, nullptr);
}

bool SystemClock::TakeCancellation() {
  if (timer_ < 0) return false;
  std::uint64_t expirations = 0;
  if (read(timer_, &expirations, sizeof(expirations)) >= 0 || errno != ECANCELED) return false;
  ArmTimer();
  return true;
}

ClockReading SystemClock::Read() {
  // Told before the clocks are read: what is set in between shows in the next reading, too.
  const bool was_set = TakeCancellation();
  const Pair clocks = ReadBoth();
  return {.wall_ns = clocks.wall_ns,
          .monotonic_ns = clocks.boot_ns - start_ns_,
          .wall_was_set = was_set};
}

std::optional<bool> WallClockIsSynchronised() {
  timex query{};
  const int state = adjtimex(&query);
  if (state == -1) return std::nullopt;
  return state != TIME_ERROR && (query.status & STA_UNSYNC) == 0;
}

}  // namespace collision::server
