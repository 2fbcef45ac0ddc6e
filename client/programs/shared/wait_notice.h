// An occasional line while a program waits.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace collision::client {

/// Prints to stderr after 3 s of waiting, then every 10 s.
class WaitNotice {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  explicit WaitNotice(Wall now) : next_(now + std::chrono::seconds(3)) {}

  void Tick(Wall now, const std::string& what) {
    if (now < next_) return;
    next_ = now + std::chrono::seconds(10);
    std::fprintf(stderr, "%s\n", what.c_str());
  }

 private:
  Wall next_;
};

}  // namespace collision::client
