#include "server/threaded_shape_builder.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace collision::server {
namespace {

/// Who stops the service expects its end within a second.
constexpr std::chrono::milliseconds kEndPatience{200};

}  // namespace

struct ThreadedShapeBuilder::Shared {
  struct Job {
    std::string hash;
    std::string bytes;  ///< Until it is begun.
    BuiltShape built;
    bool done = false;
  };

  std::size_t triangles_max = 0;
  std::mutex mutex;
  // All below is guarded by the mutex.
  std::condition_variable changed;
  std::function<void()> on_finished;
  std::map<std::string, std::shared_ptr<Job>> jobs;  ///< Neither forgotten nor handed out.
  std::deque<std::shared_ptr<Job>> waiting;
  std::vector<std::string> finished;
  std::uint64_t microseconds = 0;
  bool stopped = false;
  bool ended = false;

  /// Nobody has forgotten it, nor started the same hash anew.
  bool Wanted(const Job& job) const {
    const auto found = jobs.find(job.hash);
    return found != jobs.end() && found->second.get() == &job;
  }
};

ThreadedShapeBuilder::ThreadedShapeBuilder(std::size_t triangles_max,
                                           std::function<void()> on_finished)
    : shared_(std::make_shared<Shared>()) {
  shared_->triangles_max = triangles_max;
  shared_->on_finished = std::move(on_finished);
  worker_ = std::thread(Work, shared_);
}

ThreadedShapeBuilder::~ThreadedShapeBuilder() {
  std::unique_lock lock(shared_->mutex);
  shared_->stopped = true;
  shared_->on_finished = nullptr;
  shared_->changed.notify_all();
  const bool ended =
      shared_->changed.wait_for(lock, kEndPatience, [this] { return shared_->ended; });
  lock.unlock();
  if (ended) {
    worker_.join();
  } else {
    worker_.detach();
  }
}

void ThreadedShapeBuilder::Work(std::shared_ptr<Shared> shared) {
  std::unique_lock lock(shared->mutex);
  for (;;) {
    shared->changed.wait(lock, [&] { return shared->stopped || !shared->waiting.empty(); });
    if (shared->stopped) break;
    const std::shared_ptr<Shared::Job> job = std::move(shared->waiting.front());
    shared->waiting.pop_front();
    if (!shared->Wanted(*job)) continue;
    std::string bytes = std::move(job->bytes);
    lock.unlock();
    BuiltShape built = BuildShape(std::move(bytes), shared->triangles_max);
    lock.lock();
    shared->microseconds += static_cast<std::uint64_t>(built.microseconds);
    if (!shared->Wanted(*job)) continue;
    job->built = std::move(built);
    job->done = true;
    shared->finished.push_back(job->hash);
    shared->changed.notify_all();
    if (shared->on_finished) shared->on_finished();
  }
  shared->ended = true;
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
  const std::lock_guard lock(shared_->mutex);
  ShapeBuilderCounters counters{.building = 0, .microseconds = shared_->microseconds};
  for (const auto& [hash, job] : shared_->jobs) counters.building += job->done ? 0 : 1;
  return counters;
}

}  // namespace collision::server
