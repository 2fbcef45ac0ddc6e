// A recording in place of the network and the clock.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "server/bus/bus.h"
#include "server/bus/clock.h"
#include "server/recording/recording.h"

namespace collision::server {

/// Hands out one recorded batch for each Receive(), and the times of that batch for each Read()
/// until the next one. A daemon on it repeats every step of the recorded one and each event, bit
/// for bit, with the configuration that the recording holds. Samples are numbered otherwise where
/// the recorded one published a status within a step. It never waits, and sends nothing. Where the
/// recording begins in the middle of a run, as a segment of the flight recorder does, it finds the
/// same contacts from there on, with brackets and numbers of its own.
class ReplaySource final : public Bus, public Clock {
 public:
  using OutputFunction = std::function<void(const v1::Output&)>;
  using BatchFunction = std::function<void(const v1::RecordedBatch&)>;

  /// `source` outlives this. `output` gets what the daemon publishes, `batch` each batch before the
  /// daemon has it; they may be empty.
  explicit ReplaySource(BatchSource& source, OutputFunction output = {}, BatchFunction batch = {});

  /// Ignores `timeout` and `limit`: the boundaries of the recorded batches are inputs too. False
  /// at the end of what can be read; the reader knows whether that is the end of the recording.
  bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
               std::vector<v1::Input>* inputs) override;

  void Publish(const v1::Output& output) override;
  void Flush() override {}
  void Wake() override {}
  bool recorded() const override { return true; }
  std::uint32_t earliest_readers() const override { return earliest_readers_; }
  std::optional<std::int64_t> recorded_grant() const override { return granted_ns_; }

  /// The times of the last batch handed out; before that, those of the first.
  ClockReading Read() override { return now_; }

 private:
  BatchSource& source_;
  OutputFunction output_;
  BatchFunction batch_;
  std::optional<v1::RecordedBatch> next_;
  ClockReading now_;
  std::uint32_t earliest_readers_ = 0;      ///< At the last batch handed out.
  std::optional<std::int64_t> granted_ns_;  ///< Likewise.
};

}  // namespace collision::server
