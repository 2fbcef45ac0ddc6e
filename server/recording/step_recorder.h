// What each step saw, handed to a recording.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/bus/clock.h"
#include "server/recording/recording.h"

namespace collision::server {

/// Records the time and the inputs of each step, as long as they can be. One thread.
class StepRecorder {
 public:
  /// `sink` may be null: nothing is recorded. It outlives this.
  explicit StepRecorder(BatchSink* sink) : sink_(sink) {}

  /// Before the step applies them; `earliest_readers` is the bus's. False: nothing more is recorded
  /// from now on, told once, by failure().
  bool Record(const ClockReading& reading, std::uint32_t earliest_readers,
              std::vector<v1::Input>* inputs);

  /// One line with path and cause; empty while all is well.
  const std::string& failure() const { return failure_; }

 private:
  BatchSink* const sink_;
  std::string failure_;
};

}  // namespace collision::server
