// What a thread rings, for tests that wait for it.
#pragma once

#include <condition_variable>
#include <mutex>

namespace collision::server {

/// Counts, and waits for a count.
class Bell {
 public:
  void Ring() {
    const std::lock_guard lock(mutex_);
    ++rings_;
    changed_.notify_all();
  }
  void WaitFor(int rings) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return rings_ >= rings; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int rings_ = 0;
};

}  // namespace collision::server
