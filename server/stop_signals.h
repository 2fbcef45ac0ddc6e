// SIGTERM and SIGINT as an ordinary function call.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace collision::server {

/// Blocks SIGTERM and SIGINT in the calling thread and in all that it will start, so that they wait
/// for a StopSignalWatcher; and ignores SIGPIPE and SIGXFSZ, so that a failed write is an error
/// with a cause and not the end. To be called before any thread is made, that is before DDS.
void PrepareSignals();

/// Calls a function, on a thread of its own, when the process gets SIGTERM or SIGINT, and another one
/// if that does not help.
///
/// A thread and not a handler: a handler may call next to nothing (no mutex, no allocation, so no
/// DDS), and may run on any thread of DDS in the middle of anything. Here the functions may do
/// whatever a thread may.
class StopSignalWatcher {
 public:
  /// `stop` asks for the end. If the watcher still lives `patience` after a signal, it calls
  /// `give_up` too, once. PrepareSignals() was called; a signal that came since then counts.
  StopSignalWatcher(std::function<void()> stop, std::chrono::nanoseconds patience,
                    std::function<void()> give_up);

  /// After it, no function is called any more.
  ~StopSignalWatcher();
  StopSignalWatcher(const StopSignalWatcher&) = delete;
  StopSignalWatcher& operator=(const StopSignalWatcher&) = delete;

  /// A signal has come. Any thread.
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
