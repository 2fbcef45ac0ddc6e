#include "server/recording/flight_recorder.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace collision::server {
namespace {

constexpr std::uint64_t kBytesOfInput = 400, kBytesOfState = 600;

/// About what a batch takes in memory.
std::uint64_t BytesOf(const v1::RecordedBatch& batch) {
  std::uint64_t bytes = kBytesOfInput;
  for (const v1::Input& input : batch.inputs()) {
    bytes += kBytesOfInput;
    bytes += kBytesOfState * static_cast<std::uint64_t>(input.agent_states().states_size());
    bytes += input.shape_part().bytes().size();
  }
  return bytes;
}

}  // namespace

struct FlightRecorder::Shared {
  struct Item {
    std::shared_ptr<const v1::RecordedBatch> batch;
    std::optional<Opening> opening;
    std::uint64_t bytes = 0;
  };

  Shared(const RollingPlace& place, SegmentLimits limits, const v1::Config& config,
         const ClaimOptions& claim, std::int64_t wall_ns)
      : bytes_max(limits.queue_bytes), missed(NewestBytesMax(config), true), make_segments([=] {
          return std::make_unique<Segments>(place, limits, config, claim, wall_ns);
        }) {}

  struct NewLimits {
    RollingLimits all = {};
    SegmentLimits segment = {};
  };

  const std::uint64_t bytes_max;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Item> queue;  ///< This and all below, but `segments`: guarded by `mutex`.
  std::uint64_t bytes = 0;
  bool misses = false;  ///< Batches are left out, until the thread has written all others.
  NewestInputs missed;  ///< Their newest inputs.
  bool starts = false, has_begun = false, ends = false, has_ended = false;
  bool has_given_up = false;  ///< The thread has failed: nothing is recorded any more.
  const std::function<std::unique_ptr<Segments>()> make_segments;
  std::optional<NewLimits> new_limits;  ///< Until the thread has taken them.
  std::string failure;
  std::atomic<bool> wants_opening = false, wants_census = false;
};

FlightRecorder::FlightRecorder(const RollingPlace& place, SegmentLimits limits,
                               const v1::Config& config, const ClaimOptions& claim,
                               std::int64_t wall_ns)
    : shared_(std::make_shared<Shared>(place, limits, config, claim, wall_ns)) {
  std::thread([shared = shared_] {
    try {
      Write(shared);
    } catch (const std::exception& failure) {
      GiveUp(failure.what(), shared.get());
    }
  }).detach();
}

/// The service goes on without it.
void FlightRecorder::GiveUp(const std::string& cause, Shared* shared) {
  const std::lock_guard lock(shared->mutex);
  shared->failure = "flight recorder: it has ended: " + cause;
  spdlog::error("{}; the service goes on without it", shared->failure);
  shared->has_given_up = shared->has_ended = true;
  shared->wants_opening = shared->wants_census = false;
  shared->queue.clear();
  shared->bytes = 0;
  shared->changed.notify_all();
}

FlightRecorder::~FlightRecorder() {
  std::unique_lock lock(shared_->mutex);
  shared_->ends = true;
  shared_->changed.notify_all();
  if (shared_->changed.wait_for(lock, kFlightEndPatience, [&] { return shared_->has_ended; }))
    return;
  spdlog::warn("flight recorder: the disk does not answer; {} batches are not written",
               shared_->queue.size());
}

void FlightRecorder::Start() {
  std::unique_lock lock(shared_->mutex);
  shared_->starts = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kFlightEndPatience,
                            [&] { return shared_->has_begun || shared_->has_ended; });
}

void FlightRecorder::SetLimits(RollingLimits all, SegmentLimits segment) {
  const std::lock_guard lock(shared_->mutex);
  shared_->new_limits = {.all = all, .segment = segment};
}

void FlightRecorder::WaitUntilWritten() {
  std::unique_lock lock(shared_->mutex);
  if (!shared_->starts) return;
  shared_->changed.wait_for(lock, kFlightEndPatience, [&] { return shared_->bytes == 0; });
}

bool FlightRecorder::wants_opening() const { return shared_->wants_opening; }

bool FlightRecorder::wants_census() const { return shared_->wants_census; }

std::string FlightRecorder::failure() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->failure;
}

void FlightRecorder::Take(std::shared_ptr<const v1::RecordedBatch> batch,
                          std::optional<Opening> opening) {
  const std::uint64_t bytes = BytesOf(*batch);
  const std::lock_guard lock(shared_->mutex);
  if (shared_->has_given_up) return;
  const bool is_full = !shared_->queue.empty() && shared_->bytes + bytes > shared_->bytes_max;
  if (shared_->misses || is_full) {
    shared_->misses = true;
    for (const v1::Input& input : batch->inputs()) {
      shared_->missed.Take(input, input.SerializeAsString());
    }
    return;
  }
  if (opening) shared_->wants_opening = shared_->wants_census = false;
  shared_->bytes += bytes;
  shared_->queue.push_back({std::move(batch), std::move(opening), bytes});
  shared_->changed.notify_all();
}

void FlightRecorder::Write(const std::shared_ptr<Shared>& shared) {
  Shared& all = *shared;
  std::unique_lock lock(all.mutex);
  all.changed.wait(lock, [&] { return all.ends || all.starts; });
  std::unique_ptr<Segments> segments;
  if (all.starts) {
    segments = all.make_segments();
    all.failure = segments->failure();
    all.has_begun = true;
    all.changed.notify_all();
  }
  while (segments) {
    all.changed.wait(lock, [&] { return all.ends || all.misses || !all.queue.empty(); });
    if (all.ends && all.queue.empty()) break;
    if (all.queue.empty()) {
      NewestInputs missed = std::exchange(all.missed, NewestInputs(all.missed.bytes_max(), true));
      all.misses = false;
      lock.unlock();
      segments->Miss(&missed);
      lock.lock();
      continue;
    }
    const std::deque<Shared::Item> items = std::exchange(all.queue, {});
    const auto new_limits = std::exchange(all.new_limits, {});
    lock.unlock();
    if (new_limits) segments->SetLimits(new_limits->all, new_limits->segment);
    std::uint64_t written = 0;
    for (const Shared::Item& item : items) {
      segments->Take(*item.batch, item.opening);
      written += item.bytes;
    }
    segments->Flush();
    lock.lock();
    all.bytes -= written;
    all.changed.notify_all();
    all.failure = segments->failure();
    // One that is on its way is not asked for again.
    const auto brings_one = [](const Shared::Item& item) { return item.opening.has_value(); };
    const bool comes = std::ranges::any_of(all.queue, brings_one);
    all.wants_opening = segments->wants_opening() && !comes;
    all.wants_census = segments->wants_census() && !comes;
  }
  lock.unlock();
  if (segments) segments->End();
  lock.lock();
  all.has_ended = true;
  all.changed.notify_all();
}

}  // namespace collision::server
