#include "tests/bench/narrow_timing.h"

#include <algorithm>
#include <limits>

#include "tests/bench/measure.h"

namespace collision::bench {
namespace {

/// Shorter than this the clock's own time would count [s].
constexpr double kMeasuredMin = 4e-6;
constexpr int kRepetitionsMax = 200;

/// More than what a processor keeps for itself alone, and than most keep for all.
constexpr std::size_t kFlushBytes = std::size_t{64} << 20;
constexpr std::size_t kLineBytes = 64;

class CacheFlush {
 public:
  CacheFlush() : bytes_(kFlushBytes) {}
  void Walk() {
    for (std::size_t i = 0; i < bytes_.size(); i += kLineBytes) ++bytes_[i];
  }

 private:
  std::vector<unsigned char> bytes_;
};

double Warm(const NarrowQuery& query, const PlainPose& pose, Reply* reply) {
  Stopwatch once;
  *reply = query.ask(pose);
  const double first = once.seconds();
  const int times = static_cast<int>(
      std::clamp(kMeasuredMin / std::max(first, 1e-9), 1.0, double{kRepetitionsMax}));
  const Stopwatch watch;
  for (int i = 0; i < times; ++i) *reply = query.ask(pose);
  return watch.seconds() / times;
}

/// One walk before all questions of one task: no two of these share any data.
void TimeCold(const NarrowQueries& queries, const std::vector<PlainPose>& poses,
              const TimingPlan& plan, std::vector<QueryTimes>* all) {
  CacheFlush flush;
  for (std::size_t i = 0; i < std::min(plan.colds, poses.size()); ++i) {
    for (const Task task : {Task::kDecision, Task::kDistance, Task::kBracket}) {
      flush.Walk();
      for (std::size_t q = 0; q < queries.size(); ++q) {
        if (queries[q].task != task) continue;
        const Stopwatch watch;
        queries[q].ask(poses[i]);
        (*all)[q].cold.push_back(watch.seconds());
      }
    }
  }
}

}  // namespace

std::vector<QueryTimes> TimeQueries(const NarrowQueries& queries,
                                    const std::vector<PlainPose>& poses, const TimingPlan& plan) {
  std::vector<QueryTimes> all(queries.size());
  std::vector<bool> done(queries.size());
  for (int pass = 0; pass < plan.passes; ++pass) {
    for (std::size_t q = 0; q < queries.size(); ++q) {
      if (done[q]) continue;
      QueryTimes& times = all[q];
      times.warm.resize(poses.size(), std::numeric_limits<double>::infinity());
      times.replies.resize(poses.size());
      const Stopwatch watch;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        times.warm[i] = std::min(times.warm[i], Warm(queries[q], poses[i], &times.replies[i]));
      }
      done[q] = watch.seconds() > plan.patience;
    }
  }
  TimeCold(queries, poses, plan, &all);
  return all;
}

}  // namespace collision::bench
