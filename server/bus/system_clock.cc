#include "server/bus/system_clock.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/timerfd.h>
#include <sys/timex.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <utility>

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

SystemClock::SystemClock(std::function<void()> on_set)
    : on_set_(std::move(on_set)),
      start_ns_(Now(CLOCK_BOOTTIME)),
      timer_(timerfd_create(CLOCK_REALTIME, TFD_NONBLOCK | TFD_CLOEXEC)),
      end_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  ArmTimer();
  if (timer_ >= 0 && end_ >= 0) watch_ = std::thread([this] { Watch(); });
}

SystemClock::~SystemClock() {
  if (watch_.joinable()) {
    eventfd_write(end_, 1);
    watch_.join();
  }
  if (timer_ >= 0) close(timer_);
  if (end_ >= 0) close(end_);
}

void SystemClock::Watch() {
  pollfd waits[] = {{.fd = timer_, .events = POLLIN, .revents = 0},
                    {.fd = end_, .events = POLLIN, .revents = 0}};
  for (;;) {
    if (poll(waits, std::size(waits), -1) < 0 && errno != EINTR) return;
    if (waits[1].revents != 0 || (waits[0].revents & ~POLLIN) != 0) return;
    if (!TakeCancellation()) continue;
    was_set_ = true;
    if (on_set_) on_set_();
  }
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
  std::uint64_t expirations = 0;
  if (read(timer_, &expirations, sizeof(expirations)) >= 0 || errno != ECANCELED) return false;
  ArmTimer();
  return true;
}

ClockReading SystemClock::Read() {
  // Taken before the clocks are read: what is set in between is told with the next reading.
  const bool was_set = was_set_.exchange(false);
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
