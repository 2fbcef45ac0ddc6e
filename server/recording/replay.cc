#include "server/recording/replay.h"

#include <utility>

namespace collision::server {
namespace {

ClockReading TimesOf(const v1::RecordedBatch& batch) {
  return {.wall_ns = batch.wall_ns(),
          .monotonic_ns = batch.monotonic_ns(),
          .wall_was_set = batch.wall_was_set()};
}

}  // namespace

ReplaySource::ReplaySource(RecordingReader& reader, OutputFunction output)
    : reader_(reader), output_(std::move(output)), next_(reader.Next()) {
  if (next_) now_ = TimesOf(*next_);
}

bool ReplaySource::Receive(std::chrono::nanoseconds, std::size_t, std::vector<v1::Input>* inputs) {
  if (!next_) return false;
  now_ = TimesOf(*next_);
  earliest_readers_ = next_->earliest_readers();
  for (v1::Input& input : *next_->mutable_inputs()) inputs->push_back(std::move(input));
  next_ = reader_.Next();
  return true;
}

void ReplaySource::Publish(const v1::Output& output) {
  if (output_) output_(output);
}

}  // namespace collision::server
