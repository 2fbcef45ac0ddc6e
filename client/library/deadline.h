// Bounded waiting.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

namespace collision::client {

/// The rest of a time to wait, on the monotonic clock or another one. Any duration is allowed, also
/// the longest.
class Deadline {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit Deadline(std::chrono::nanoseconds timeout,
                    std::function<Time()> now = std::chrono::steady_clock::now)
      : timeout_(timeout), now_(std::move(now)), start_(now_()) {}

  /// Never negative; zero when the time is over.
  std::chrono::nanoseconds Remaining() const {
    return std::max<std::chrono::nanoseconds>(timeout_ - (now_() - start_),
                                              std::chrono::nanoseconds(0));
  }

 private:
  std::chrono::nanoseconds timeout_;
  std::function<Time()> now_;
  Time start_;
};

}  // namespace collision::client
