// The step of the service: everything that happens between the network and the core.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "server/bus/bus.h"
#include "server/bus/clock.h"
#include "server/claim/journal.h"
#include "server/claim/quarantine.h"
#include "server/claim/service_claim.h"
#include "server/process/process_meter.h"
#include "server/publish/event_log.h"
#include "server/shapes/shape_builder.h"

namespace collision::server {

class BatchSink;
class ContactSink;
class FlightSink;

inline constexpr std::size_t kStateAgentsMax = 1000;

/// What a daemon may have beside bus and clock.
struct DaemonParts {
  BatchSink* recorder = nullptr;    ///< Gets every batch before it is applied.
  FlightSink* flight = nullptr;     ///< Likewise, without ever ending the service.
  ContactSink* contacts = nullptr;  ///< Gets every contact that is published.
  std::unique_ptr<ShapeBuilder> shape_builder = nullptr;  ///< Null: shapes are built in the step
                                                          ///< after they have arrived.
  JournalParts journal = {};                              ///< Keeps term, roster and grants.
  Quarantine* quarantine = nullptr;  ///< Notes which message is applied, for the next start.
  std::string process = {};  ///< ProcessText(): its status shows it, and other services log it.
  ClaimOptions claim = {};   ///< By default it serves from the first step.
  const ProcessMeter* meter = nullptr;  ///< For its status; null: no time is measured.
  /// Called while a step goes on, after each bounded piece of the detector's work. True: a status
  /// is published now, in the middle of the step. Decides nothing else.
  std::function<bool()> progress = nullptr;
};

/// Owns the parts of the service and runs them in steps, on one thread. A step
///  1. waits until messages have arrived or something is due, and reads the clock;
///  2. sorts the batch and records it: times and inputs, as they will be applied;
///  3. applies each input: the codec validates it, world, shapes and detector take it;
///  4. advances the detector to now; publishes events, the earliest intersection (for its readers),
///     rejections, clearances, and the status every `status_period_s` or when simulators come and
///     go; flushes the bus.
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
  /// by reference or pointer outlives the daemon.
  Daemon(const v1::Config& config, Bus& bus, Clock& clock, DaemonParts parts = {});
  ~Daemon();

  /// Runs one step. False: the bus has ended, Stop() was called, another service has the world, or
  /// the batch cannot be recorded (on_recording_failure END) or the journal not be written
  /// (on_state_failure END).
  bool Step();

  /// Makes Step() return false soon. Any thread.
  void Stop();

  /// Why nothing is kept for the next start, although that is wanted; empty: it is.
  const std::string& state_failure() const;

  /// What it does, in one line for people: "serves world "lab": 3 simulators, 112 agents, next
  /// contact not before 4.1 s".
  std::string StatusLine() const;

  /// All that it knows, for the log: its status as JSON, then agents, at most kStateAgentsMax.
  std::vector<std::string> StateLines() const;

  /// Its claim to the world.
  const ServiceClaim& claim() const;

  /// Every collision event published so far.
  const EventLog& event_log() const;
  /// Likewise of hypothetical agents.
  const EventLog& screening_log() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision::server
