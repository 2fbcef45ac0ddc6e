#include "server/stop_signals.h"

#include <pthread.h>

#include <csignal>
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

StopSignalWatcher::StopSignalWatcher(std::function<void()> stop)
    : stop_(std::move(stop)), thread_([this] { Watch(); }) {}

StopSignalWatcher::~StopSignalWatcher() {
  ending_ = true;
  pthread_kill(thread_.native_handle(), SIGTERM);  // to that thread alone: it ends the wait
  thread_.join();
}

void StopSignalWatcher::Watch() {
  const sigset_t set = StopSignalSet();
  for (int signal = 0; sigwait(&set, &signal) == 0 && !ending_;) {
    stopped_ = true;
    stop_();
  }
}

}  // namespace collision::server
