// Wakes a thread that waits for DDS.
#pragma once

#include <atomic>
#include <thread>

#include "dds/dds.h"

namespace collision::dds {

/// Triggers a guard condition on behalf of code that must not call DDS: signal handlers. An eventfd
/// carries the call to a thread of its own.
class Waker {
 public:
  /// `guard` is a guard condition and outlives this. Throws std::runtime_error without an eventfd.
  explicit Waker(dds_entity_t guard);
  Waker(const Waker&) = delete;
  Waker& operator=(const Waker&) = delete;
  ~Waker();

  /// From any thread and from signal handlers.
  void Wake() noexcept;

 private:
  void Run();

  const dds_entity_t guard_;
  const int event_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace collision::dds
