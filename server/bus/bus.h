// The world outside the daemon, as an interface that carries messages.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::server {

/// A line for the log.
struct BusWarning {
  const char* matter;  ///< However many lines of one there are, they do not hide those of others.
  std::string text;
};

/// Where inputs come from and outputs go. One thread uses a bus, except for Wake().
/// Implementations: DdsBus (the network), ReplaySource (a recording), and in tests a simulated
/// network that loses, delays, duplicates and reorders from one seed.
class Bus {
 public:
  virtual ~Bus() = default;

  /// Waits until a message has arrived, `timeout` is over or Wake() was called; then appends the
  /// messages that have arrived, at most `limit`; the rest stays for the next call. False: no more
  /// messages will come.
  virtual bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                       std::vector<v1::Input>* inputs) = 0;

  virtual void Publish(const v1::Output& output) = 0;

  /// This simulator is not there any more, nor will what was published to it be asked for.
  virtual void Forget(std::uint64_t simulator_id) { static_cast<void>(simulator_id); }

  /// Sends everything published so far. Called at the end of each step, and with a wall clock also
  /// after the events of the step.
  virtual void Flush() = 0;

  /// If this process stands still for longer than `standstill` between Receive() and what it
  /// publishes after it, that is held back: another service may have taken over meanwhile. 0:
  /// never.
  virtual void HoldAfter(std::chrono::nanoseconds standstill) { static_cast<void>(standstill); }

  /// What is held back is published, or dropped.
  virtual void EndHold(bool publish) { static_cast<void>(publish); }

  /// Ends a Receive() that waits. Any thread.
  virtual void Wake() = 0;

  /// Whether its batches come from a recording and hold everything that the recorded daemon added
  /// to them, so that the daemon adds nothing.
  virtual bool recorded() const { return false; }

  /// Recorded: the greatest time that the recorded daemon had granted before this step, which its
  /// simulators follow; nullopt: none, or not known.
  virtual std::optional<std::int64_t> recorded_grant() const { return std::nullopt; }

  /// What the bus did to protect the service, and what it heard of its network, since the last
  /// call.
  virtual std::vector<BusWarning> TakeWarnings() { return {}; }

  /// The programs that write more than they may, each with what is dropped of it, in words for the
  /// status.
  virtual std::vector<std::string> flooding() const { return {}; }

  /// Who read the earliest intersection, which is computed for them alone, when Receive() returned.
  virtual std::uint32_t earliest_readers() const { return 1; }

  /// How long the oldest message of a simulator had waited here that Receive() appended last.
  virtual std::chrono::nanoseconds waited() const { return std::chrono::nanoseconds(0); }

  /// What the network did not deliver or accept, for the status: Counters of collision.idl, each
  /// name once.
  virtual std::vector<v1::Counter> network_counters() const { return {}; }
};

}  // namespace collision::server
