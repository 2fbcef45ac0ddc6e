#include "server/recording/replay/replay.h"

#include <utility>

namespace collision::server {
namespace {

ClockReading TimesOf(const v1::RecordedBatch& batch) {
  return {.wall_ns = batch.wall_ns(),
          .monotonic_ns = batch.monotonic_ns(),
          .wall_was_set = batch.wall_was_set()};
}

}  // namespace

ReplaySource::ReplaySource(BatchSource& source, OutputFunction output, BatchFunction batch)
    : source_(source), output_(std::move(output)), batch_(std::move(batch)), next_(source.Next()) {
  if (next_) now_ = TimesOf(*next_);
}

bool ReplaySource::Receive(std::chrono::nanoseconds, std::size_t, std::vector<v1::Input>* inputs) {
  if (!next_) return false;
  if (batch_) batch_(*next_);
  now_ = TimesOf(*next_);
  earliest_readers_ = next_->earliest_readers();
  granted_ns_.reset();
  if (next_->has_granted_ns()) granted_ns_ = next_->granted_ns();
  for (v1::Input& input : *next_->mutable_inputs()) inputs->push_back(std::move(input));
  next_ = source_.Next();
  return true;
}

void ReplaySource::Publish(const v1::Output& output) {
  if (output_) output_(output);
}

}  // namespace collision::server
