// SIGTERM and SIGINT as an ordinary function call.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace collision::server {

/// Blocks SIGTERM and SIGINT in the calling thread and in all that it will start, so that they wait
/// for a StopSignalWatcher; and ignores SIGPIPE and SIGXFSZ, so that a failed write is an error
/// with a cause and not the end. To be called before any thread is made, that is before DDS.
void PrepareSignals();

/// Calls a function, on a thread of its own, for each SIGTERM or SIGINT that the process gets.
///
/// A thread and not a handler: a handler may call next to nothing (no mutex, no allocation, so no
/// DDS), and may run on any thread of DDS in the middle of anything. Here the function may do
/// whatever a thread may.
class StopSignalWatcher {
 public:
  /// PrepareSignals() was called. A signal that came since then counts.
  explicit StopSignalWatcher(std::function<void()> stop);

  /// After it, the function is not called any more.
  ~StopSignalWatcher();
  StopSignalWatcher(const StopSignalWatcher&) = delete;
  StopSignalWatcher& operator=(const StopSignalWatcher&) = delete;

  /// A signal has come. Any thread.
  bool stopped() const { return stopped_; }

 private:
  void Watch();

  std::function<void()> stop_;
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace collision::server
