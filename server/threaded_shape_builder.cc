#include "server/threaded_shape_builder.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace collision::server {
namespace {

/// Who stops the service expects its end within a second.
constexpr std::chrono::milliseconds kEndPatience{200};

/// A shape of so many bytes, some 10,000 triangles, is built within a second or two.
constexpr std::size_t kSmallBytes = 250'000;

}  // namespace

struct ThreadedShapeBuilder::Shared {
  struct Job {
    std::string hash;
    std::string bytes;  ///< Until it is begun.
    BuiltShape built;
    bool done = false;
  };

  BuildOptions options;
  std::mutex mutex;
  // All below is guarded by the mutex.
  std::condition_variable changed;
  std::function<void()> on_finished;
  std::map<std::string, std::shared_ptr<Job>> jobs;  ///< Neither forgotten nor handed out.
  std::list<std::shared_ptr<Job>> waiting;           ///< In the order of their start.
  std::vector<std::string> finished;
  std::uint64_t microseconds = 0;
  bool stopped = false;
  int working = 0;  ///< Workers that have not ended.

  /// Nobody has forgotten it, nor started the same hash anew.
  bool Wanted(const Job& job) const {
    const auto found = jobs.find(job.hash);
    return found != jobs.end() && found->second.get() == &job;
  }

  /// The smallest that waits, of equal ones the first, if it is no larger; null: none.
  std::shared_ptr<Job> TakeWaiting(std::size_t bytes_max) {
    const auto smallest = std::min_element(
        waiting.begin(), waiting.end(),
        [](const auto& a, const auto& b) { return a->bytes.size() < b->bytes.size(); });
    if (smallest == waiting.end() || (*smallest)->bytes.size() > bytes_max) return nullptr;
    std::shared_ptr<Job> job = std::move(*smallest);
    waiting.erase(smallest);
    return job;
  }
};

ThreadedShapeBuilder::ThreadedShapeBuilder(BuildOptions options, std::function<void()> on_finished)
    : shared_(std::make_shared<Shared>()) {
  shared_->options = std::move(options);
  shared_->on_finished = std::move(on_finished);
  const std::size_t limits[] = {std::numeric_limits<std::size_t>::max(), kSmallBytes};
  shared_->working = static_cast<int>(std::size(limits));
  for (const std::size_t bytes_max : limits) workers_.emplace_back(Work, shared_, bytes_max);
}

ThreadedShapeBuilder::~ThreadedShapeBuilder() {
  std::unique_lock lock(shared_->mutex);
  shared_->stopped = true;
  shared_->on_finished = nullptr;
  shared_->changed.notify_all();
  const bool ended =
      shared_->changed.wait_for(lock, kEndPatience, [this] { return shared_->working == 0; });
  lock.unlock();
  for (std::thread& worker : workers_) ended ? worker.join() : worker.detach();
}

void ThreadedShapeBuilder::Work(std::shared_ptr<Shared> shared, std::size_t bytes_max) {
  std::unique_lock lock(shared->mutex);
  for (;;) {
    std::shared_ptr<Shared::Job> job;
    shared->changed.wait(lock, [&] {
      if (!shared->stopped) job = shared->TakeWaiting(bytes_max);
      return shared->stopped || job != nullptr;
    });
    if (shared->stopped) break;
    if (!shared->Wanted(*job)) continue;
    std::string bytes = std::move(job->bytes);
    lock.unlock();
    BuiltShape built = BuildShape(job->hash, std::move(bytes), shared->options);
    lock.lock();
    shared->microseconds += static_cast<std::uint64_t>(built.microseconds);
    if (!shared->Wanted(*job)) continue;
    job->built = std::move(built);
    job->done = true;
    shared->finished.push_back(job->hash);
    shared->changed.notify_all();
    if (shared->on_finished) shared->on_finished();
  }
  --shared->working;
  shared->changed.notify_all();
}

void ThreadedShapeBuilder::Start(const std::string& hash, std::string bytes) {
  auto job = std::make_shared<Shared::Job>();
  job->hash = hash;
  job->bytes = std::move(bytes);
  const std::lock_guard lock(shared_->mutex);
  shared_->jobs[hash] = job;
  shared_->waiting.push_back(std::move(job));
  shared_->changed.notify_all();
}

bool ThreadedShapeBuilder::has_finished() const {
  const std::lock_guard lock(shared_->mutex);
  return !shared_->finished.empty();
}

std::vector<std::string> ThreadedShapeBuilder::TakeFinished() {
  const std::lock_guard lock(shared_->mutex);
  return std::exchange(shared_->finished, {});
}

BuiltShape ThreadedShapeBuilder::Await(const std::string& hash) {
  std::unique_lock lock(shared_->mutex);
  const auto found = shared_->jobs.find(hash);
  if (found == shared_->jobs.end()) {
    throw std::logic_error("a shape is awaited that was not started");
  }
  const std::shared_ptr<Shared::Job> job = found->second;
  shared_->changed.wait(lock, [&job] { return job->done; });
  std::erase(shared_->finished, hash);
  shared_->jobs.erase(hash);
  return std::move(job->built);
}

void ThreadedShapeBuilder::Forget(const std::string& hash) {
  const std::lock_guard lock(shared_->mutex);
  // Bytes that wait for the worker are memory too.
  std::erase_if(shared_->waiting, [&hash](const auto& job) { return job->hash == hash; });
  std::erase(shared_->finished, hash);
  shared_->jobs.erase(hash);
}

ShapeBuilderCounters ThreadedShapeBuilder::counters() const {
  ShapeBuilderCounters counters;
  if (shared_->options.cache) counters.cache = shared_->options.cache->counters();
  const std::lock_guard lock(shared_->mutex);
  counters.microseconds = shared_->microseconds;
  for (const auto& [hash, job] : shared_->jobs) counters.building += job->done ? 0 : 1;
  return counters;
}

}  // namespace collision::server
