// The heart of the service: everything that happens between the network and the core.
#pragma once

#include <memory>

#include "idl/config.pb.h"
#include "server/bus.h"
#include "server/clock.h"
#include "server/event_log.h"

namespace collision::server {

class BatchSink;

/// Drains the bus, sorts the batch, applies it, advances the detector, publishes what follows. It
/// runs on one thread; only Stop() may be called from another. The same batches with the same clock
/// readings give the same event log, bit for bit.
class Daemon {
 public:
  /// `config` is complete (CompleteConfig()) and valid. `recorder` gets every batch as it is
  /// applied; it may be null. Everything passed in outlives the daemon.
  Daemon(const v1::Config& config, Bus& bus, Clock& clock, BatchSink* recorder);
  ~Daemon();

  /// Waits until something arrives or is due, and deals with it. False: the bus has ended, or
  /// Stop() was called.
  bool Step();

  /// Makes Step() return false soon. From any thread and from signal handlers.
  void Stop();

  /// Every collision event published so far.
  const EventLog& event_log() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision::server
