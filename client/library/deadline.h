// Bounded waiting.
#pragma once

#include <algorithm>
#include <chrono>

namespace collision::client {

/// The rest of a time to wait, on the monotonic clock. Any duration is allowed, also the longest.
class Deadline {
 public:
  explicit Deadline(std::chrono::nanoseconds timeout) : timeout_(timeout) {}

  /// Never negative; zero when the time is over.
  std::chrono::nanoseconds Remaining() const {
    const std::chrono::nanoseconds elapsed = std::chrono::steady_clock::now() - start_;
    return std::max(timeout_ - elapsed, std::chrono::nanoseconds(0));
  }

 private:
  std::chrono::nanoseconds timeout_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace collision::client
