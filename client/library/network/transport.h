// The network as the client library sees it: messages in, and for simulators messages out.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// What arrived: outputs of the service, inputs of simulators.
struct Arrivals {
  std::vector<v1::Output> outputs;
  std::vector<v1::Input> inputs;
};

/// Listens to a world and cannot write. One thread at a time.
class Receiver {
 public:
  virtual ~Receiver() = default;

  /// Waits at most `timeout` for an arrival, then appends everything that has arrived.
  virtual void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) = 0;

  /// Whether a service of this world is alive.
  virtual bool service_alive() const = 0;

  /// A sentence when the credentials with which it is connected end before long, or have ended.
  virtual std::optional<std::string> TakeCredentialsWarning() { return std::nullopt; }

  /// The monotonic time by which timeouts count.
  virtual std::chrono::steady_clock::time_point Now() const {
    return std::chrono::steady_clock::now();
  }
};

/// Also writes, for one simulator or operator.
class Transport : public Receiver {
 public:
  /// A description, states, a clock, a part of a shape, or a removal of an agent or a shape; of an
  /// operator a command, of a watcher its watch; a hello. Never waits for a reader.
  virtual void Write(const v1::Input& message) = 0;

  /// Sends what was written and is still buffered.
  virtual void Flush() = 0;
};

}  // namespace collision::client
