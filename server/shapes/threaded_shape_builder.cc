#include "server/shapes/threaded_shape_builder.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "collision_core/base/check.h"

namespace collision::server {
namespace {

/// An operator who stops the service expects its end within a second.
constexpr std::chrono::milliseconds kEndPatience{200};

/// A shape of so many bytes, some 10,000 triangles, is built within a second or two.
constexpr std::size_t kSmallBytes = 250'000;

/// Simulators whose last turn is remembered: as many as a world can have.
constexpr std::size_t kTurnsMax = 1024;

constexpr std::size_t kAnyBytes = std::numeric_limits<std::size_t>::max();

}  // namespace

struct ThreadedShapeBuilder::Limits {
  std::size_t bytes_max;
  bool refines;
};

struct ThreadedShapeBuilder::Shared {
  struct Job {
    std::string hash;
    std::uint64_t simulator = 0;
    std::string bytes;  ///< Until it is begun.
    std::size_t size = 0;
    std::shared_ptr<const shape::Shape> refining;  ///< With the coarse tree, from then on.
    std::optional<BuiltShape> coarse;  ///< Finished, and neither handed out nor replaced.
    std::optional<BuiltShape> whole;   ///< Finished.
  };

  BuildOptions options;
  std::mutex mutex;
  // All below is guarded by the mutex.
  std::condition_variable changed;
  std::function<void()> on_finished;
  std::map<std::string, std::shared_ptr<Job>> jobs;  ///< Neither forgotten nor handed out.
  std::list<std::shared_ptr<Job>> waiting;           ///< In the order of their start.
  std::map<std::uint64_t, std::uint64_t> turns;      ///< By simulator: its last turn.
  std::uint64_t turn = 0;
  std::vector<ReadyTree> finished;
  std::uint64_t microseconds = 0;
  bool stopped = false;
  int working = 0;             ///< Workers that have not ended.
  std::exception_ptr failure;  ///< What the first worker that failed threw; null: none has.

  /// Neither forgotten nor started anew since.
  bool Wanted(const Job& job) const {
    const auto found = jobs.find(job.hash);
    return found != jobs.end() && found->second.get() == &job;
  }

  /// Simulators take turns: of the jobs within the limits, takes one of the simulator whose last
  /// turn was the longest ago. Of its jobs it takes the smallest one whose first tree waits, else
  /// the smallest one that is to be refined; of equal ones the first. Null: there is none.
  std::shared_ptr<Job> TakeWaiting(const Limits& limits) {
    const auto order = [this, &limits](const Job& job) {
      const bool refine = job.refining != nullptr;
      const bool taken = job.size <= limits.bytes_max && (!refine || limits.refines);
      const auto last = turns.find(job.simulator);
      return std::tuple(!taken, last == turns.end() ? 0 : last->second, refine, job.size);
    };
    const auto next =
        std::min_element(waiting.begin(), waiting.end(),
                         [&](const auto& a, const auto& b) { return order(*a) < order(*b); });
    if (next == waiting.end() || std::get<0>(order(**next))) return nullptr;
    std::shared_ptr<Job> job = std::move(*next);
    waiting.erase(next);
    CountTurn(job->simulator);
    return job;
  }

  void CountTurn(std::uint64_t simulator) {
    turns[simulator] = ++turn;
    if (turns.size() <= kTurnsMax) return;
    turns.erase(std::min_element(turns.begin(), turns.end(),
                                 [](const auto& a, const auto& b) { return a.second < b.second; }));
  }

  void Remove(const std::string& hash) {
    std::erase_if(finished, [&hash](const ReadyTree& tree) { return tree.hash == hash; });
    jobs.erase(hash);
  }

  /// A wanted tree replaces a coarse one that has not been taken.
  void Finish(const std::shared_ptr<Job>& job, BuiltShape built) {
    const ReadyTree coarse{job->hash, true};
    if (built.coarse) {
      job->refining = built.shape;
      job->coarse = std::move(built);
      finished.push_back(coarse);
      waiting.push_back(job);
    } else {
      if (std::erase(finished, coarse) > 0) job->coarse.reset();
      job->refining.reset();
      job->whole = std::move(built);
      finished.push_back({job->hash});
    }
    changed.notify_all();
    if (on_finished) on_finished();
  }

  /// Carries what a worker threw to the daemon's thread, where RethrowFailure() throws it
  /// again.
  void Fail(std::exception_ptr thrown) {
    const std::lock_guard lock(mutex);
    if (!failure) failure = std::move(thrown);
    changed.notify_all();
    if (on_finished) on_finished();
  }

  void RethrowFailure() const {
    if (failure) std::rethrow_exception(failure);
  }
};

ThreadedShapeBuilder::ThreadedShapeBuilder(BuildOptions options, std::function<void()> on_finished)
    : shared_(std::make_shared<Shared>()) {
  shared_->options = std::move(options);
  shared_->on_finished = std::move(on_finished);
  const Limits all[] = {{kAnyBytes, true}, {kAnyBytes, false}, {kSmallBytes, true}};
  shared_->working = static_cast<int>(std::size(all));
  for (const Limits& limits : all) workers_.emplace_back(Work, shared_, limits);
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

void ThreadedShapeBuilder::Work(const std::shared_ptr<Shared>& shared, const Limits& limits) {
  try {
    BuildUntilStopped(shared.get(), limits);
  } catch (...) {
    shared->Fail(std::current_exception());
  }
  const std::lock_guard lock(shared->mutex);
  --shared->working;
  shared->changed.notify_all();
}

void ThreadedShapeBuilder::BuildUntilStopped(Shared* shared, const Limits& limits) {
  std::unique_lock lock(shared->mutex);
  for (;;) {
    std::shared_ptr<Shared::Job> job;
    shared->changed.wait(lock, [&] {
      if (!shared->stopped) job = shared->TakeWaiting(limits);
      return shared->stopped || job != nullptr;
    });
    if (shared->stopped) return;
    if (!shared->Wanted(*job)) continue;
    std::string bytes = std::move(job->bytes);
    const std::shared_ptr<const shape::Shape> coarse = job->refining;
    lock.unlock();
    BuiltShape built = coarse ? Refine(job->hash, *coarse, shared->options)
                              : BuildFirst(job->hash, std::move(bytes), shared->options);
    lock.lock();
    shared->microseconds += static_cast<std::uint64_t>(built.microseconds);
    if (shared->Wanted(*job)) shared->Finish(job, std::move(built));
  }
}

void ThreadedShapeBuilder::Start(const std::string& hash, std::string bytes,
                                 std::uint64_t simulator) {
  auto job = std::make_shared<Shared::Job>();
  job->hash = hash;
  job->simulator = simulator;
  job->bytes = std::move(bytes);
  job->size = job->bytes.size();
  const std::lock_guard lock(shared_->mutex);
  shared_->jobs[hash] = job;
  shared_->waiting.push_back(std::move(job));
  shared_->changed.notify_all();
}

bool ThreadedShapeBuilder::has_finished() const {
  const std::lock_guard lock(shared_->mutex);
  return !shared_->finished.empty() || shared_->failure;
}

std::vector<ReadyTree> ThreadedShapeBuilder::TakeFinished() {
  const std::lock_guard lock(shared_->mutex);
  shared_->RethrowFailure();
  return std::exchange(shared_->finished, {});
}

BuiltShape ThreadedShapeBuilder::Await(const ReadyTree& tree) {
  std::unique_lock lock(shared_->mutex);
  const auto found = shared_->jobs.find(tree.hash);
  CORE_CHECK(found != shared_->jobs.end(), "a shape that is awaited was started");
  const std::shared_ptr<Shared::Job> job = found->second;
  const auto built_or_failed = [&] {
    return shared_->failure || job->whole || (tree.coarse && job->coarse);
  };
  shared_->changed.wait(lock, built_or_failed);
  shared_->RethrowFailure();
  const bool coarse = tree.coarse && job->coarse;
  BuiltShape built = std::move(coarse ? *job->coarse : *job->whole);
  if (coarse) {
    std::erase(shared_->finished, tree);
    job->coarse.reset();
  } else {
    shared_->Remove(tree.hash);
  }
  return built;
}

void ThreadedShapeBuilder::Forget(const std::string& hash) {
  const std::lock_guard lock(shared_->mutex);
  // Bytes that wait for a worker are memory too.
  std::erase_if(shared_->waiting, [&hash](const auto& job) { return job->hash == hash; });
  shared_->Remove(hash);
}

ShapeBuilderCounters ThreadedShapeBuilder::counters() const {
  ShapeBuilderCounters counters;
  if (shared_->options.cache) counters.cache = shared_->options.cache->counters();
  const std::lock_guard lock(shared_->mutex);
  counters.microseconds = shared_->microseconds;
  for (const auto& [hash, job] : shared_->jobs) counters.building += job->whole ? 0 : 1;
  return counters;
}

}  // namespace collision::server
