// The spaceship simulator measured: pair tests, frames, and whether all see the same contacts.
#include "tests/bench/harness/measure.h"

#include <algorithm>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "tests/bench/harness/frame_times.h"
#include "tests/bench/harness/number_hash.h"
#include "tests/bench/hubbard/parts.h"

namespace collision::bench {
namespace {

/// Pair tests of one flight at most.
constexpr std::size_t kTestsMax = 2000;

/// Turk's cells [m].
constexpr double kCells[] = {1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48};

constexpr double kStandardVolume = 2000;

/// Whether a figure shows the scene: two sizes at the demo's density.
bool IsStandard(const HubbardScene& scene) {
  return scene.options.volume == kStandardVolume &&
         (scene.options.drones == 20 || scene.options.drones == 100);
}

struct Test {
  std::int64_t frame;
  ShipPair pair;
};

std::vector<Test> TestsOf(const Flight& flight) {
  std::vector<Test> tests;
  for (std::int64_t frame = 0; frame < flight.frames(); ++frame) {
    for (const ShipPair& pair : flight.NearPairs(frame)) tests.push_back({frame, pair});
  }
  // Evenly chosen, the first among them.
  const std::size_t every = tests.size() / kTestsMax + 1;
  std::vector<Test> some;
  for (std::size_t i = 0; i < tests.size(); i += every) some.push_back(tests[i]);
  return some;
}

bool Touch(const Flight& flight, const Test& test) {
  const auto& contacts = flight.contacts(test.frame);
  return std::binary_search(contacts.begin(), contacts.end(), test.pair);
}

struct NarrowTimes {
  double median = 0, total = 0;
};

NarrowTimes MeasureNarrow(const HubbardSettings& settings, const HubbardScene& scene,
                          const std::vector<Test>& tests, const ShipComparison& compare,
                          const std::string& method, HubbardReport* report) {
  std::vector<double> least(tests.size(), numeric::kInfinity);
  NumberHash hash;
  std::size_t contacts = 0, wrong = 0;
  for (int pass = 0; pass <= settings.repetitions(); ++pass) {
    for (std::size_t i = 0; i < tests.size(); ++i) {
      const Stopwatch watch;
      const bool touch = compare(scene.flight, tests[i].frame, tests[i].pair);
      least[i] = std::min(least[i], watch.seconds());
      if (pass > 0) continue;
      contacts += touch;
      wrong += touch != Touch(scene.flight, tests[i]);
      hash.Add(touch);
    }
  }
  NarrowTimes times{Median(least), 0};
  for (const double seconds : least) times.total += seconds;
  HubbardRow row = RowOf("narrow", scene, method);
  row.seconds = times.median;
  row.hash = hash.text();
  row.remark = std::to_string(tests.size()) + " pair tests, " + std::to_string(contacts) +
               " touch; in all " + SecondsText(times.total);
  if (wrong > 0) row.remark += "; ANSWERS DIFFER: " + std::to_string(wrong);
  row.more.insert(
      row.more.end(),
      {Number("total_s", times.total), Number("p90_s", Quantile(least, 0.9)),
       Number("slowest_s", Quantile(least, 1)), Number("tests", static_cast<double>(tests.size())),
       Number("contacts", static_cast<double>(contacts)),
       Number("wrong", static_cast<double>(wrong))});
  report->Add(std::move(row));
  return times;
}

struct Run {
  std::vector<double> frames;  ///< The least of the repetitions, each [s].
  std::size_t tests = 0, contacts = 0, differ = 0;
  NumberHash hash;

  double total() const {
    double sum = 0;
    for (const double seconds : frames) sum += seconds;
    return sum;
  }
};

using MakeShipBroadPhase = std::function<std::unique_ptr<ShipBroadPhase>()>;

Run Fly(const Flight& flight, const MakeShipBroadPhase& make, const ShipComparison& compare,
        int repetitions) {
  Run run;
  run.frames.assign(static_cast<std::size_t>(flight.frames()), numeric::kInfinity);
  std::vector<ShipPair> near, touching;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const auto broad = make();
    for (std::int64_t frame = 0; frame < flight.frames(); ++frame) {
      near.clear(), touching.clear();
      const Stopwatch watch;
      broad->Look(flight, frame, &near);
      for (const ShipPair& pair : near) {
        if (compare(flight, frame, pair)) touching.push_back(pair);
      }
      double& least = run.frames[static_cast<std::size_t>(frame)];
      least = std::min(least, watch.seconds());
      if (repetition > 0) continue;
      std::sort(near.begin(), near.end());
      std::sort(touching.begin(), touching.end());
      run.tests += near.size(), run.contacts += touching.size();
      const bool same = near == flight.NearPairs(frame) && touching == flight.contacts(frame);
      run.differ += !same;
      for (const ShipPair& pair : touching) run.hash.Add(pair.lower), run.hash.Add(pair.higher);
      run.hash.Add(-1);
    }
  }
  return run;
}

void AddRun(const HubbardScene& scene, const std::string& method, const Run& run,
            HubbardReport* report) {
  HubbardRow row = RowOf("both", scene, method);
  row.seconds = run.total() / static_cast<double>(run.frames.size());
  row.hash = run.hash.text();
  const double slowest = *std::max_element(run.frames.begin(), run.frames.end());
  row.remark = "slowest frame " + SecondsText(slowest) + ", " + std::to_string(run.tests) +
               " pair tests, " + std::to_string(run.contacts) + " contacts in frames";
  if (run.differ > 0) row.remark += "; ANSWERS DIFFER in " + std::to_string(run.differ) + " frames";
  row.more.insert(row.more.end(),
                  {Number("total_s", run.total()), Number("tests", static_cast<double>(run.tests)),
                   Number("contacts", static_cast<double>(run.contacts)),
                   Number("frames_that_differ", static_cast<double>(run.differ))});
  for (Field& field : FrameFields(run.frames)) row.more.push_back(std::move(field));
  report->Add(std::move(row));
  report->FigureGreatest("frames_that_differ", static_cast<double>(run.differ));
}

/// In all and of the slowest frames, the least and the most of all flights. Returns the former.
double Compare(const Run& theirs, const Run& ours, const std::string& name, HubbardReport* report) {
  const auto slowest = [](const Run& run) {
    return *std::max_element(run.frames.begin(), run.frames.end());
  };
  const double total = theirs.total() / ours.total(), slow = slowest(theirs) / slowest(ours);
  report->FigureLeast("both_" + name + "_over_ours_worst", total);
  report->FigureGreatest("both_" + name + "_over_ours_best", total);
  report->FigureLeast("slowest_frame_" + name + "_over_ours_worst", slow);
  report->FigureGreatest("slowest_frame_" + name + "_over_ours_best", slow);
  return total;
}

/// The cell in which the hash alone takes the least total.
double BestCell(const Flight& flight) {
  const ShipComparison none = [](const Flight&, std::int64_t, const ShipPair&) { return false; };
  double best = 0, least = numeric::kInfinity;
  for (const double cell : kCells) {
    const double total = Fly(
                             flight, [cell] { return MakeTurk(cell); }, none, 2)
                             .total();
    if (total < least) least = total, best = cell;
  }
  return best;
}

}  // namespace

void NarrowRows(const HubbardSettings& settings, const HubbardScene& scene, HubbardReport* report) {
  const bool ours = settings.Wants(RowOf("narrow", scene, "sphere trees").path());
  const bool theirs = settings.Wants(RowOf("narrow", scene, "BSP trees").path());
  if (!ours && !theirs) return;
  const std::vector<Test> tests = TestsOf(scene.flight);
  if (tests.empty()) return;
  NarrowTimes own, other;
  if (ours) {
    own = MeasureNarrow(settings, scene, tests, BySphereTrees(scene.spaceship, scene.drone),
                        "sphere trees", report);
  }
  if (theirs) {
    other = MeasureNarrow(settings, scene, tests, ByBspTrees(scene.spaceship, scene.drone),
                          "BSP trees", report);
  }
  if (!ours || !theirs || !IsStandard(scene)) return;
  report->Figure("narrow_bsp_over_ours_" + std::to_string(scene.options.drones),
                 other.total / own.total);
}

void BothRows(const HubbardSettings& settings, const HubbardScene& scene, HubbardReport* report) {
  const std::string of_trees = " and sphere trees", of_bsp = " and BSP trees";
  const MakeShipBroadPhase horns = [] {
    return MakeHorns(std::make_unique<broad_phase::AdaptiveBroadPhase>());
  };
  const double cell = BestCell(scene.flight);
  const MakeShipBroadPhase turk = [cell] { return MakeTurk(cell); };
  const ShipComparison trees = BySphereTrees(scene.spaceship, scene.drone);
  const ShipComparison bsp = ByBspTrees(scene.spaceship, scene.drone);
  const auto fly = [&](const std::string& method, const MakeShipBroadPhase& make,
                       const ShipComparison& compare) -> std::optional<Run> {
    if (!settings.Wants(RowOf("both", scene, method).path())) return std::nullopt;
    const Run run = Fly(scene.flight, make, compare, settings.repetitions());
    AddRun(scene, method, run, report);
    return run;
  };
  const std::string of_turk = "Turk, cell " + Format("%g m", cell);
  const auto ours = fly("horns" + of_trees, horns, trees);
  fly("horns" + of_bsp, horns, bsp);
  const auto mixed = fly(of_turk + of_trees, turk, trees);
  const auto theirs = fly(of_turk + of_bsp, turk, bsp);
  if (ours && mixed) Compare(*mixed, *ours, "turk_trees", report);
  if (!ours || !theirs) return;
  const double total = Compare(*theirs, *ours, "turk_bsp", report);
  if (!IsStandard(scene)) return;
  report->Figure("both_turk_bsp_over_ours_" + std::to_string(scene.options.drones), total);
}

}  // namespace collision::bench
