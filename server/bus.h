// The world outside the daemon, as messages.
#pragma once

#include <chrono>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::server {

/// Where inputs come from and outputs go. One thread uses a bus. Implementations: the DDS bus, the
/// simulated bus (tests: loss, delay, duplication, reordering from one seed), the replay bus.
class Bus {
 public:
  virtual ~Bus() = default;

  /// Waits until something arrived, `timeout` is over or Wake() was called; then appends everything that
  /// arrived, at most `limit` messages (the rest stays for the next call). False: no more will ever come.
  virtual bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                       std::vector<v1::Input>* inputs) = 0;

  virtual void Publish(const v1::Output& output) = 0;

  /// At the end of a step: everything published leaves now.
  virtual void Flush() = 0;

  /// Ends a Receive() that waits. May be called from any thread and from signal handlers.
  virtual void Wake() = 0;

  /// Its batches are those of a recording, with all that the recorded daemon added to them: nothing
  /// is added again.
  virtual bool recorded() const { return false; }

  /// What the network did not deliver or take, for the status. Names as in collision.idl's Counter,
  /// each once.
  virtual std::vector<v1::Counter> network_counters() const { return {}; }
};

}  // namespace collision::server
