// The heart of the service: everything that happens between the network and the core.
#pragma once

#include <memory>

#include "idl/config.pb.h"
#include "server/bus.h"
#include "server/clock.h"
#include "server/event_log.h"
#include "server/shape_builder.h"

namespace collision::server {

class BatchSink;

/// Drains the bus, sorts the batch, applies it, advances the detector, publishes what follows. It
/// runs on one thread; only Stop() may be called from another. The same batches with the same clock
/// readings give the same event log, bit for bit.
class Daemon {
 public:
  /// `config` is complete (CompleteConfig()) and valid. `recorder` gets every batch as it is
  /// applied; it may be null. Everything passed in by reference outlives the daemon. Without a
  /// `shape_builder` shapes are built in the step after they have arrived.
  Daemon(const v1::Config& config, Bus& bus, Clock& clock, BatchSink* recorder,
         std::unique_ptr<ShapeBuilder> shape_builder = nullptr);
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
