// SIGTERM and SIGINT as an ordinary function call.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace collision::server {

/// Blocks SIGTERM and SIGINT in the calling thread and in all threads that it starts afterwards, so
/// that they stay pending for a StopSignalWatcher. Ignores SIGPIPE and SIGXFSZ, so that a failed
/// write is an error with a cause and does not end the process. Call it before any thread is made,
/// DDS included.
void PrepareSignals();

/// Calls a function, on a thread of its own, when the process gets SIGTERM or SIGINT, and a second
/// one if the process has not ended its work after a while.
///
/// A signal handler may call next to nothing (no mutex, no allocation, so no DDS) and may run on
/// any thread. These functions run on an ordinary thread and may do what a thread may.
class StopSignalWatcher {
 public:
  /// `stop` asks for the end. If the watcher still exists `patience` after a signal, it calls
  /// `give_up` too, once. Requires that PrepareSignals() was called; a signal since then counts.
  StopSignalWatcher(std::function<void()> stop, std::chrono::nanoseconds patience,
                    std::function<void()> give_up);

  /// Afterwards neither function is called any more.
  ~StopSignalWatcher();
  StopSignalWatcher(const StopSignalWatcher&) = delete;
  StopSignalWatcher& operator=(const StopSignalWatcher&) = delete;

  /// Whether a signal has come. Any thread.
  bool stopped() const { return stopped_; }

 private:
  void Watch();
  bool EndsInTime() const;

  const std::function<void()> stop_;
  const std::chrono::nanoseconds patience_;
  const std::function<void()> give_up_;
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace collision::server
