// The paper's experiment, 60 frames a second until the first collision: ours beside Turk's hash.
#include <algorithm>
#include <cmath>

#include "tests/baselines/local_loop.h"
#include "tests/baselines/turk_hash.h"
#include "tests/baselines/window_loop.h"
#include "tests/bench/broad_phase/methods.h"
#include "tests/bench/broad_phase/parts.h"
#include "tests/bench/harness/frame_times.h"
#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

using baselines::CollisionLoop;
using baselines::MovingCubes;
using MakeLoop = std::function<std::unique_ptr<CollisionLoop>()>;

/// A quick run has no more cubes, and none that fill less.
constexpr std::uint32_t kQuickAgents = 1000;
constexpr double kQuickDensity = 0.001;

/// Frames at most: a minute of the cubes' time.
constexpr std::int64_t kFramesMax = 3600;

/// Turk's cells, in sides of a cube.
constexpr double kCells[] = {1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24};

/// With fewer cubes a frame is too short for the processor's clock; the one on the wall is asked,
/// and the least of several runs taken.
constexpr std::uint32_t kClockAgents = 1000;

struct LoopTimes {
  double total = 0, slowest = 0;  ///< [s]
  baselines::FirstCollision first;
};

/// Where the times of the frames begin among the values of a run.
constexpr std::ptrdiff_t kFramesFrom = 5;

/// Each frame counts with its least time of several identical runs: the work is the same, and what
/// the machine does beside it is not of interest. Moving the cubes is not counted.
std::vector<double> Measure(const MovingCubes::Options& options, const MakeLoop& make,
                            int repetitions) {
  KeepMemory();
  std::vector<double> least;
  baselines::FirstCollision first;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    MovingCubes cubes(options);
    const auto loop = make();
    first = {};
    for (std::int64_t frame = 0; frame < kFramesMax && first.frame < 0; ++frame) {
      const double seconds_before = options.count < kClockAgents ? WallNow() : CpuNow();
      const auto pair = loop->Look(cubes);
      const double seconds = (options.count < kClockAgents ? WallNow() : CpuNow()) - seconds_before;
      if (repetition == 0) least.push_back(seconds);
      const auto at = static_cast<std::size_t>(frame);
      least[at] = std::min(least[at], seconds);
      if (pair) first = {frame, *pair};
      cubes.NextFrame();
    }
  }
  double total = 0;
  for (const double seconds : least) total += seconds;
  std::vector<double> values = {
      total, *std::max_element(least.begin(), least.end()), static_cast<double>(first.frame),
      static_cast<double>(first.pair.first), static_cast<double>(first.pair.second)};
  values.insert(values.end(), least.begin(), least.end());
  return values;
}

class Configuration {
 public:
  Configuration(const Settings& settings, const MovingCubes::Options& options, Report* report)
      : settings_(settings), options_(options), report_(report) {}

  /// nullopt: past the cut-off, failed, or not wanted.
  std::optional<LoopTimes> Run(const std::string& name, const MakeLoop& make, bool shown) {
    Row row;
    char scene[40];
    std::snprintf(scene, sizeof scene, "cubes %g %%", 100 * options_.density);
    row.part = "turk", row.scene = scene, row.agents = options_.count, row.contestant = name;
    row.cut_off = settings_.cut_off();
    if (!settings_.Wants(row.path())) return std::nullopt;
    const ApartResult result =
        RunApart(row.cut_off, [&] { return Measure(options_, make, settings_.quick ? 3 : 5); });
    row.failed = result.status == ApartStatus::kFailed;
    std::optional<LoopTimes> times;
    if (result.status == ApartStatus::kDone) {
      const auto& v = result.values;
      times = LoopTimes{v[0],
                        v[1],
                        {static_cast<std::int64_t>(v[2]),
                         {static_cast<std::uint32_t>(v[3]), static_cast<std::uint32_t>(v[4])}}};
      row.seconds = v[0];
      row.answer = Answer{v[2] >= 0, times->first.pair.first, times->first.pair.second,
                          times->first.frame * MovingCubes::kFrameNs};
      const std::vector<double> frames(v.begin() + kFramesFrom, v.end());
      row.more = FrameFields(frames);
      char text[80];
      std::snprintf(text, sizeof text, "slowest frame %.3g us of %zu", v[1] * 1e6, frames.size());
      row.remark = text;
    }
    if (!shown) return times;
    report_->Add(row);
    if (times && !first_) first_ = times->first;
    if (times && !(times->first == *first_)) report_->Mark("ANSWERS DIFFER");
    return times;
  }

 private:
  const Settings& settings_;
  MovingCubes::Options options_;
  Report* report_;
  std::optional<baselines::FirstCollision> first_;
};

/// Turk's hash in the cell that takes the least total.
std::optional<LoopTimes> BestTurk(Configuration* configuration) {
  std::optional<LoopTimes> best;
  double best_cell = 0;
  for (const double cell : kCells) {
    const auto make = [cell] {
      return std::make_unique<baselines::TurkHash>(cell * MovingCubes::kSide);
    };
    const auto times = configuration->Run("Turk", make, false);
    if (times && (!best || times->total < best->total)) best = times, best_cell = cell;
  }
  if (!best) return best;
  char name[40];
  std::snprintf(name, sizeof name, "Turk, cell %g", best_cell);
  return configuration->Run(
      name,
      [best_cell] { return std::make_unique<baselines::TurkHash>(best_cell * MovingCubes::kSide); },
      true);
}

void Worst(std::optional<double>* worst, double ratio) {
  *worst = std::min(worst->value_or(ratio), ratio);
}

}  // namespace

void TurkPart(const Settings& settings, Report* report) {
  std::optional<double> total_worst, slowest_worst;
  for (const std::uint32_t count : {10u, 100u, 1000u, 10'000u, 100'000u}) {
    for (const double density : {0.0001, 0.001, 0.01, 0.1}) {
      if (settings.quick && (count > kQuickAgents || density < kQuickDensity)) continue;
      MovingCubes::Options options;
      options.count = count, options.density = density;
      Configuration configuration(settings, options, report);
      const Method& method = OurChoice();
      const auto ours = configuration.Run(
          "window loop, " + method.name,
          [&method] { return std::make_unique<baselines::WindowLoop>(method.make()); }, true);
      configuration.Run(
          "local loop, " + method.name,
          [&method] { return std::make_unique<baselines::LocalLoop>(method.make()); }, true);
      const auto turk = BestTurk(&configuration);
      if (!ours || !turk) continue;
      Worst(&total_worst, turk->total / ours->total);
      Worst(&slowest_worst, turk->slowest / ours->slowest);
    }
  }
  report->Figure("turk_total_worst", total_worst);
  report->Figure("turk_slowest_frame_worst", slowest_worst);
}

}  // namespace collision::bench
