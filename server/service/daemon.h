// The step of the service: everything that happens between the network and the core.
#pragma once

#include <memory>

#include "idl/config.pb.h"
#include "server/bus/bus.h"
#include "server/bus/clock.h"
#include "server/publish/event_log.h"
#include "server/shapes/shape_builder.h"

namespace collision::server {

class BatchSink;

/// Owns the parts of the service and runs them in steps, on one thread. A step
///  1. waits until messages have arrived or something is due, and reads the clock;
///  2. sorts the batch and records it: times and inputs, as they will be applied;
///  3. applies each input: the codec validates it, world, shapes and detector take it;
///  4. advances the detector to now; publishes events, the earliest intersection, rejections,
///     clearances, and the status every `status_period_s` or when simulators come and go; flushes
///     the bus.
/// Nothing else reads a clock or the network, so the same batches with the same clock readings give
/// the same event log, bit for bit.
///
/// Due are the status, an overdue description or shape, and the release of a silent simulator; with
/// a wall clock also the next temporal resolution. With a simulated clock nothing happens between
/// inputs.
///
/// A failed check leaves Step() as a CheckFailure, also one that failed on a thread that builds
/// shapes. The daemon may only be destroyed then.
class Daemon {
 public:
  /// Requires that `config` is complete (CompleteConfig()) and valid, and that everything passed in
  /// by reference outlives the daemon. `recorder` gets every batch before it is applied; it may be
  /// null. Without a `shape_builder`, shapes are built in the step after they have arrived.
  Daemon(const v1::Config& config, Bus& bus, Clock& clock, BatchSink* recorder,
         std::unique_ptr<ShapeBuilder> shape_builder = nullptr);
  ~Daemon();

  /// Runs one step. False: the bus has ended, Stop() was called, or the batch could not be
  /// recorded.
  bool Step();

  /// Makes Step() return false soon. Any thread.
  void Stop();

  /// Every collision event published so far.
  const EventLog& event_log() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision::server
