#include "server/process/signals.h"

#include <pthread.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <initializer_list>
#include <string>
#include <utility>

namespace collision::server {
namespace {

constexpr std::chrono::seconds kAskAgainAfter{1};

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

/// A service blocks its signals, to wait for them: so SIGHUP ends no other process by mistake.
bool BlocksItsSignals(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("SigBlk:")) continue;
    const std::uint64_t blocked =
        std::strtoull(line.c_str() + line.find_first_of("\t ") + 1, nullptr, 16);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1}) {
      if ((blocked >> (signal - 1) & 1) == 0) return false;
    }
    return true;
  }
  return false;
}

ReloadAnswer AskToReload(pid_t service, std::chrono::nanoseconds patience) {
  const sigset_t answers = SetOf({SIGUSR1});
  pthread_sigmask(SIG_BLOCK, &answers, nullptr);
  const auto end = std::chrono::steady_clock::now() + patience;
  do {
    if (kill(service, 0) != 0) return ReloadAnswer::kNoProcess;
    if (!BlocksItsSignals(service)) return ReloadAnswer::kNoService;
    // Of two that ask at once the service may see one: each asks until it is answered.
    if (sigqueue(service, SIGHUP, {}) != 0) return ReloadAnswer::kNoProcess;
    const timespec wait = TimeSpecOf(std::min<std::chrono::nanoseconds>(patience, kAskAgainAfter));
    siginfo_t info{};
    if (sigtimedwait(&answers, &info, &wait) > 0 && info.si_pid == service) {
      return static_cast<ReloadAnswer>(info.si_value.sival_int);
    }
  } while (std::chrono::steady_clock::now() < end);
  return ReloadAnswer::kNoAnswer;
}

void AnswerReload(pid_t asker, ReloadAnswer answer) {
  if (asker > 0) sigqueue(asker, SIGUSR1, {.sival_int = static_cast<int>(answer)});
}

}  // namespace collision::server
