#include "tests/bench/pairs/timing.h"

#include <algorithm>
#include <limits>

#include "tests/bench/harness/measure.h"

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

double Warm(const PairMethod& method, const PlainPose& pose, Reply* reply) {
  Stopwatch once;
  *reply = method.ask(pose);
  const double first = once.seconds();
  const int times = static_cast<int>(
      std::clamp(kMeasuredMin / std::max(first, 1e-9), 1.0, double{kRepetitionsMax}));
  const Stopwatch watch;
  for (int i = 0; i < times; ++i) *reply = method.ask(pose);
  return watch.seconds() / times;
}

/// One walk before all queries of one task: no two of these share any data.
void TimeCold(const PairMethods& methods, const std::vector<PlainPose>& poses,
              const TimingPlan& plan, std::vector<MethodTimes>* all) {
  CacheFlush flush;
  for (std::size_t i = 0; i < std::min(plan.colds, poses.size()); ++i) {
    for (const Task task : {Task::kDecision, Task::kDistance, Task::kBracket}) {
      flush.Walk();
      for (std::size_t m = 0; m < methods.size(); ++m) {
        if (methods[m].task != task) continue;
        const Stopwatch watch;
        methods[m].ask(poses[i]);
        (*all)[m].cold.push_back(watch.seconds());
      }
    }
  }
}

}  // namespace

std::vector<MethodTimes> TimeMethods(const PairMethods& methods,
                                     const std::vector<PlainPose>& poses, const TimingPlan& plan) {
  std::vector<MethodTimes> all(methods.size());
  std::vector<bool> done(methods.size());
  for (int pass = 0; pass < plan.passes; ++pass) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (done[m]) continue;
      MethodTimes& times = all[m];
      times.warm.resize(poses.size(), std::numeric_limits<double>::infinity());
      times.replies.resize(poses.size());
      const Stopwatch watch;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        times.warm[i] = std::min(times.warm[i], Warm(methods[m], poses[i], &times.replies[i]));
      }
      done[m] = watch.seconds() > plan.patience;
    }
  }
  TimeCold(methods, poses, plan, &all);
  return all;
}

}  // namespace collision::bench
