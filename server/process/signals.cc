#include "server/process/signals.h"

#include <pthread.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <initializer_list>
#include <utility>

namespace collision::server {
namespace {

sigset_t SetOf(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  return set;
}

sigset_t WatchedSignals() { return SetOf({SIGTERM, SIGINT, SIGHUP, SIGUSR1}); }

timespec TimeSpecOf(std::chrono::nanoseconds time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return {.tv_sec = time.count() / kSecond, .tv_nsec = time.count() % kSecond};
}

}  // namespace

void PrepareSignals() {
  const sigset_t set = WatchedSignals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

SignalWatcher::SignalWatcher(SignalActions actions)
    : actions_(std::move(actions)), thread_([this] { Watch(); }) {}

SignalWatcher::~SignalWatcher() {
  ending_ = true;
  pthread_kill(thread_.native_handle(), SIGTERM);  // to that thread alone: it ends the wait
  thread_.join();
}

void SignalWatcher::Watch() {
  const sigset_t set = WatchedSignals();
  siginfo_t info{};
  for (;;) {
    const int signal = sigwaitinfo(&set, &info);
    if (ending_) return;
    if (signal == SIGHUP && actions_.reload) {
      // Whoever sends it with sigqueue() waits for an answer: AskToReload().
      actions_.reload(info.si_code == SI_QUEUE ? info.si_pid : 0);
    } else if (signal == SIGUSR1 && actions_.dump) {
      actions_.dump();
    } else if (signal == SIGTERM || signal == SIGINT) {
      break;
    }
  }
  stopped_ = true;
  actions_.stop();
  if (!EndsInTime()) actions_.give_up();
}

/// Whether the destructor's signal comes; those of others change nothing.
bool SignalWatcher::EndsInTime() const {
  const sigset_t set = WatchedSignals();
  const auto end = std::chrono::steady_clock::now() + actions_.patience;
  while (!ending_) {
    const std::chrono::nanoseconds left = end - std::chrono::steady_clock::now();
    if (left.count() <= 0) return false;
    const timespec wait = TimeSpecOf(left);
    sigtimedwait(&set, nullptr, &wait);
  }
  return true;
}

ReloadAnswer AskToReload(pid_t service, std::chrono::nanoseconds patience) {
  const sigset_t answers = SetOf({SIGUSR1, SIGUSR2});
  pthread_sigmask(SIG_BLOCK, &answers, nullptr);
  if (sigqueue(service, SIGHUP, {}) != 0) return ReloadAnswer::kNoProcess;
  const auto end = std::chrono::steady_clock::now() + patience;
  for (;;) {
    const std::chrono::nanoseconds left = end - std::chrono::steady_clock::now();
    if (left.count() <= 0) return ReloadAnswer::kNoAnswer;
    const timespec wait = TimeSpecOf(left);
    siginfo_t info{};
    const int signal = sigtimedwait(&answers, &info, &wait);
    if (signal < 0 || info.si_pid != service) continue;
    return signal == SIGUSR1 ? ReloadAnswer::kDone : ReloadAnswer::kRefused;
  }
}

void AnswerReload(pid_t asker, bool done) {
  if (asker > 0) kill(asker, done ? SIGUSR1 : SIGUSR2);
}

}  // namespace collision::server
