#include "server/recording/step_recorder.h"

namespace collision::server {

SharedBatch BatchOf(const ClockReading& reading, std::uint32_t earliest_readers, Instant granted,
                    std::vector<v1::Input> inputs) {
  auto batch = std::make_shared<v1::RecordedBatch>();
  batch->set_wall_ns(reading.wall_ns);
  batch->set_monotonic_ns(reading.monotonic_ns);
  batch->set_wall_was_set(reading.wall_was_set);
  batch->set_earliest_readers(earliest_readers);
  if (granted != Instant::Always()) batch->set_granted_ns(granted.nanoseconds());
  batch->mutable_inputs()->Reserve(static_cast<int>(inputs.size()));
  for (v1::Input& input : inputs) *batch->add_inputs() = std::move(input);
  return batch;
}

bool StepRecorder::Record(const SharedBatch& batch) {
  if (flight_ != nullptr) flight_->Take(batch, std::exchange(opening_, std::nullopt));
  if (sink_ == nullptr || !failure_.empty()) return true;
  const bool kept = sink_->Record(*batch);
  if (!kept) failure_ = sink_->error();
  return kept;
}

}  // namespace collision::server
