// The network as the client library sees it: messages in, and for simulators messages out.
#pragma once

#include <chrono>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// What arrived: outputs from the service, inputs from simulators.
struct Arrivals {
  std::vector<v1::Output> outputs;
  std::vector<v1::Input> inputs;
};

/// Listens to a world and cannot write. One thread at a time.
class Receiver {
 public:
  virtual ~Receiver() = default;

  /// Waits at most `timeout` until something arrives, then appends all that has.
  virtual void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) = 0;

  /// Is a service of this world alive?
  virtual bool service_alive() const = 0;
};

/// Speaks for one simulator as well.
class Transport : public Receiver {
 public:
  /// A description, states, a clock, a part of a shape, or a removal of an agent or a shape. Never
  /// waits for a reader.
  virtual void Write(const v1::Input& message) = 0;

  /// Everything written leaves now.
  virtual void Flush() = 0;
};

}  // namespace collision::client
