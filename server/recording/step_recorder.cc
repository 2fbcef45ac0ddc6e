#include "server/recording/step_recorder.h"

#include <utility>

namespace collision::server {

bool StepRecorder::Record(const ClockReading& reading, std::uint32_t earliest_readers,
                          std::vector<v1::Input>* inputs) {
  if (sink_ == nullptr || !failure_.empty()) return true;
  v1::RecordedBatch batch;
  batch.set_wall_ns(reading.wall_ns);
  batch.set_monotonic_ns(reading.monotonic_ns);
  batch.set_wall_was_set(reading.wall_was_set);
  batch.set_earliest_readers(earliest_readers);
  for (v1::Input& input : *inputs) *batch.add_inputs() = std::move(input);
  const bool kept = sink_->Record(batch);
  for (std::size_t i = 0; i < inputs->size(); ++i) {
    (*inputs)[i] = std::move(*batch.mutable_inputs(static_cast<int>(i)));
  }
  if (!kept) failure_ = sink_->error();
  return kept;
}

}  // namespace collision::server
