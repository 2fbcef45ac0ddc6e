// What each step saw, handed to a recording.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "collision_core/base/instant.h"
#include "server/bus/clock.h"
#include "server/recording/flight_recorder.h"
#include "server/recording/recording.h"

namespace collision::server {

/// Nobody changes it any more.
using SharedBatch = std::shared_ptr<const v1::RecordedBatch>;
using BatchInputs = google::protobuf::RepeatedPtrField<v1::Input>;

/// The batch of a step: its times, who reads the earliest intersection, the greatest time granted
/// before (Always(): none), and its inputs, which it takes.
SharedBatch BatchOf(const ClockReading& reading, std::uint32_t earliest_readers, Instant granted,
                    std::vector<v1::Input> inputs);

/// Records the batches of the steps: with --record as long as they can be, and beside that in the
/// flight recorder. One thread.
class StepRecorder {
 public:
  /// Either may be null. They outlive this.
  StepRecorder(BatchSink* sink, FlightSink* flight) : sink_(sink), flight_(flight) {}

  /// The flight recorder is to begin a segment, with the batch recorded next.
  bool wants_opening() const { return flight_ != nullptr && flight_->wants_opening(); }
  bool wants_census() const { return flight_ != nullptr && flight_->wants_census(); }
  void Open(Opening opening) { opening_ = std::move(opening); }

  /// Before the step applies it. False: nothing more is recorded to the sink from now on, told
  /// once, by failure().
  bool Record(const SharedBatch& batch);

  /// One line with path and cause; empty while all is well.
  const std::string& failure() const { return failure_; }

  /// Of both, as extensions of the status; empty where all is well.
  std::map<std::string, std::string> Failures() const {
    return {{"recording_failure", failure_},
            {"flight_failure", flight_ == nullptr ? "" : flight_->failure()}};
  }

 private:
  BatchSink* const sink_;
  FlightSink* const flight_;
  std::optional<Opening> opening_;
  std::string failure_;
};

}  // namespace collision::server
