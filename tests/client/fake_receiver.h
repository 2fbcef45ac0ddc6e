// A monitor's network under the test's control.
#pragma once

#include <chrono>
#include <utility>

#include "client/library/network/transport.h"

namespace collision::client {

/// Hands over once what the test has put into `next`, which outlives it.
class FakeReceiver final : public Receiver {
 public:
  explicit FakeReceiver(Arrivals* next) : next_(*next) {}
  void Receive(std::chrono::nanoseconds, Arrivals* arrivals) override {
    *arrivals = std::exchange(next_, {});
  }
  bool service_alive() const override { return true; }

 private:
  Arrivals& next_;
};

}  // namespace collision::client
