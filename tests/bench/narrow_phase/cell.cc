#include "tests/bench/narrow_phase/cell.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "tests/bench/harness/measure.h"
#include "tests/bench/pairs/ours.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 5;

/// A library's time counts while at most this part of its answers is wrong.
constexpr double kWrongMax = 0.05;

/// Below this a distance's error is that of its coordinates, which are about 1 m [m].
constexpr double kDistanceFloor = 1e-14;

struct Accuracy {
  std::size_t wrong = 0;
  std::size_t undecided = 0;
  double error_max = 0;  ///< Of distances, relative.
};

/// By how far the answer misses what is certain, relative to the distance; 0: it does not.
double ErrorOf(Task task, const Cell& cell, const Reply& reply, const Reply& certain) {
  const double diameter = cell.diameter;
  const double allowed = task == Task::kBracket ? kBracketShare * diameter
                                                : kDistanceShare * certain.upper + kDistanceFloor;
  if (cell.gap.overlap) {
    const double off = std::max(reply.lower, 0.0);
    return off > 0 || reply.upper > allowed ? std::max(off, reply.upper) / diameter : 0;
  }
  const double off = task == Task::kBracket
                         ? std::max({0.0, reply.lower - certain.upper, certain.lower - reply.upper})
                         : std::abs(reply.middle() - certain.middle());
  const bool wide = reply.upper - reply.lower > allowed;
  const bool missed = task == Task::kBracket ? off > 0 : off > allowed;
  return wide || missed ? std::max(off, reply.upper - reply.lower) / certain.upper : 0;
}

Accuracy AccuracyOf(Task task, const Cell& cell, const std::vector<Reply>& replies) {
  Accuracy accuracy;
  for (std::size_t i = 0; i < replies.size(); ++i) {
    if (task == Task::kDecision) {
      const bool undecided = replies[i].lower != replies[i].upper;
      accuracy.undecided += undecided;
      accuracy.wrong += !undecided && (replies[i].lower > 0.5) != cell.gap.overlap;
      continue;
    }
    const double error = ErrorOf(task, cell, replies[i], cell.distances[i]);
    accuracy.wrong += error > 0;
    accuracy.error_max = std::max(accuracy.error_max, error);
  }
  return accuracy;
}

std::string RemarkOn(Task task, const Accuracy& accuracy, std::size_t count) {
  std::string remark;
  if (accuracy.wrong > 0) {
    remark = "ANSWERS DIFFER: " + std::to_string(accuracy.wrong) + " of " + std::to_string(count);
    if (task != Task::kDecision) remark += Format(", by up to %.2g of it", accuracy.error_max);
  }
  if (accuracy.undecided > 0) {
    remark += (remark.empty() ? "" : "; ") + std::to_string(accuracy.undecided) + " undecided";
  }
  return remark;
}

std::string HashOf(const std::vector<Reply>& replies) {
  NumberHash hash;
  for (const Reply& reply : replies) hash.Add(reply.lower), hash.Add(reply.upper);
  return hash.text();
}

/// Medians of one cell, of those whose answers are good enough to count.
struct Medians {
  struct Pair {
    std::optional<double> warm, cold;
  };
  std::map<Task, Pair> ours, peers;

  void Add(const PairMethod& method, const NarrowRow& row) {
    if (method.origin != Origin::kOurs && method.origin != Origin::kLibrary) return;
    Pair& best = (method.origin == Origin::kOurs ? ours : peers)[method.task];
    if (row.warm) best.warm = std::min(best.warm.value_or(*row.warm), *row.warm);
    if (row.cold) best.cold = std::min(best.cold.value_or(*row.cold), *row.cold);
  }

  /// Peers in the one task over ours in the other goes into the figure, warm and cold.
  void Compare(Task of_peers, Task of_ours, const std::string& figure, NarrowReport* report) {
    const Pair &theirs = peers[of_peers], &own = ours[of_ours];
    if (theirs.warm && own.warm) report->FigureLeast(figure + "_worst", *theirs.warm / *own.warm);
    if (theirs.cold && own.cold) {
      report->FigureLeast(figure + "_cold_worst", *theirs.cold / *own.cold);
    }
  }
};

void SetFigures(const Cell& cell, Medians medians, NarrowReport* report) {
  const GapClass& gap = cell.gap;
  const std::string start = cell.kind.empty() ? "" : "convex_";
  const bool tiny = !gap.overlap && gap.share == 0.001, wide = gap.share == 0.5;
  medians.Compare(Task::kDecision, Task::kDecision,
                  start + "decision" +
                      (tiny   ? "_gap_0_1pct"
                       : wide ? "_gap_50pct"
                              : ""),
                  report);
  // Bodies that overlap have no distance.
  if (gap.overlap) return;
  medians.Compare(Task::kDistance, Task::kDistance, start + "distance", report);
  if (!cell.kind.empty()) return;
  medians.Compare(Task::kDistance, Task::kBracket, "bracket_1pct_vs_fcl_distance", report);
}

}  // namespace

NarrowRow RowOf(const Cell& cell, const PairMethod& method) {
  NarrowRow row;
  row.part = cell.kind + Name(method.task);
  row.mesh = cell.bodies;
  row.triangles = cell.triangles;
  row.gap = cell.gap.name;
  row.contestant = method.name;
  return row;
}

PairMethods WantedOf(const NarrowSettings& settings, const Cell& cell, const PairMethods& methods) {
  PairMethods wanted;
  std::copy_if(
      methods.begin(), methods.end(), std::back_inserter(wanted),
      [&](const PairMethod& method) { return settings.Wants(RowOf(cell, method).path()); });
  return wanted;
}

bool DrawCell(const NarrowSettings& settings, const PairOracle& oracle, const PairMethod& measure,
              Cell* cell) {
  cell->sample = SamplePoses(oracle, cell->diameter, cell->gap, settings.poses(), kSeed);
  for (const PlainPose& pose : cell->sample.poses) cell->distances.push_back(measure.ask(pose));
  return !cell->distances.empty();
}

void Measure(const NarrowSettings& settings, const Cell& cell, const PairMethods& methods,
             NarrowReport* report) {
  const auto all = TimeMethods(methods, cell.sample.poses, settings.plan());
  Medians medians;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const MethodTimes& times = all[m];
    NarrowRow row = RowOf(cell, methods[m]);
    row.warm = Median(times.warm), row.cold = Median(times.cold);
    row.hash = HashOf(times.replies);
    const Accuracy accuracy = AccuracyOf(methods[m].task, cell, times.replies);
    const auto count = static_cast<double>(times.replies.size());
    row.remark = RemarkOn(methods[m].task, accuracy, times.replies.size());
    row.more = {Number("poses", count),
                Number("redrawn", static_cast<double>(cell.sample.redrawn)),
                Number("warm_p90_s", Quantile(times.warm, 0.9)),
                Number("warm_max_s", Quantile(times.warm, 1)),
                Number("wrong", static_cast<double>(accuracy.wrong)),
                Number("undecided", static_cast<double>(accuracy.undecided))};
    const bool counts = methods[m].origin != Origin::kLibrary ||
                        static_cast<double>(accuracy.wrong) <= kWrongMax * count;
    if (counts) medians.Add(methods[m], row);
    if (!counts) row.remark += "; does not count";
    report->Add(std::move(row));
  }
  SetFigures(cell, medians, report);
}

}  // namespace collision::bench
