#include "server/process/stop_signals.h"

#include <pthread.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <utility>

namespace collision::server {
namespace {

sigset_t StopSignalSet() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  return set;
}

}  // namespace

void PrepareSignals() {
  const sigset_t set = StopSignalSet();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

StopSignalWatcher::StopSignalWatcher(std::function<void()> stop, std::chrono::nanoseconds patience,
                                     std::function<void()> give_up)
    : stop_(std::move(stop)),
      patience_(patience),
      give_up_(std::move(give_up)),
      thread_([this] { Watch(); }) {}

StopSignalWatcher::~StopSignalWatcher() {
  ending_ = true;
  pthread_kill(thread_.native_handle(), SIGTERM);  // to that thread alone: it ends the wait
  thread_.join();
}

void StopSignalWatcher::Watch() {
  const sigset_t set = StopSignalSet();
  int signal = 0;
  if (sigwait(&set, &signal) != 0 || ending_) return;
  stopped_ = true;
  stop_();
  if (!EndsInTime()) give_up_();
}

/// Whether the destructor's signal comes; those of others change nothing.
bool StopSignalWatcher::EndsInTime() const {
  const sigset_t set = StopSignalSet();
  const auto end = std::chrono::steady_clock::now() + patience_;
  while (!ending_) {
    const auto left = std::chrono::nanoseconds(end - std::chrono::steady_clock::now()).count();
    if (left <= 0) return false;
    constexpr std::int64_t kSecond = 1'000'000'000;
    const timespec wait{.tv_sec = left / kSecond, .tv_nsec = left % kSecond};
    sigtimedwait(&set, nullptr, &wait);
  }
  return true;
}

}  // namespace collision::server
