#include "tests/bench/narrow_cell.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/bench/measure.h"
#include "tests/bench/narrow_ours.h"

namespace collision::bench {
namespace {

/// A library's time counts while at most this part of its answers is wrong.
constexpr double kWrongMax = 0.05;

/// Below this a distance's error is that of its coordinates, which are about 1 m [m].
constexpr double kDistanceFloor = 1e-14;

struct Judgement {
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

Judgement Judge(Task task, const Cell& cell, const std::vector<Reply>& replies) {
  Judgement judgement;
  for (std::size_t i = 0; i < replies.size(); ++i) {
    if (task == Task::kDecision) {
      const bool undecided = replies[i].lower != replies[i].upper;
      judgement.undecided += undecided;
      judgement.wrong += !undecided && (replies[i].lower > 0.5) != cell.gap.overlap;
      continue;
    }
    const double error = ErrorOf(task, cell, replies[i], cell.distances[i]);
    judgement.wrong += error > 0;
    judgement.error_max = std::max(judgement.error_max, error);
  }
  return judgement;
}

std::string RemarkOn(Task task, const Judgement& judgement, std::size_t count) {
  std::string remark;
  if (judgement.wrong > 0) {
    remark = "ANSWERS DIFFER: " + std::to_string(judgement.wrong) + " of " + std::to_string(count);
    if (task != Task::kDecision) remark += Format(", by up to %.2g of it", judgement.error_max);
  }
  if (judgement.undecided > 0) {
    remark += (remark.empty() ? "" : "; ") + std::to_string(judgement.undecided) + " undecided";
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

  void Add(const NarrowQuery& query, const NarrowRow& row) {
    if (query.who != Who::kOurs && query.who != Who::kLibrary) return;
    Pair& best = (query.who == Who::kOurs ? ours : peers)[query.task];
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

NarrowRow RowOf(const Cell& cell, const NarrowQuery& query) {
  NarrowRow row;
  row.part = cell.kind + Name(query.task);
  row.mesh = cell.bodies;
  row.triangles = cell.triangles;
  row.gap = cell.gap.name;
  row.contestant = query.contestant;
  return row;
}

bool Wanted(const NarrowSettings& settings, const NarrowRow& row) {
  const std::string name = row.part + "/" + row.mesh + "/" + row.gap + "/" + row.contestant;
  return name.find(settings.only) != std::string::npos;
}

void Measure(const NarrowSettings& settings, const Cell& cell, const NarrowQueries& queries,
             NarrowReport* report) {
  const auto all = TimeQueries(queries, cell.sample.poses, settings.plan());
  Medians medians;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const QueryTimes& times = all[q];
    NarrowRow row = RowOf(cell, queries[q]);
    row.warm = Median(times.warm), row.cold = Median(times.cold);
    row.hash = HashOf(times.replies);
    const Judgement judgement = Judge(queries[q].task, cell, times.replies);
    const auto count = static_cast<double>(times.replies.size());
    row.remark = RemarkOn(queries[q].task, judgement, times.replies.size());
    row.more = {Number("poses", count),
                Number("redrawn", static_cast<double>(cell.sample.redrawn)),
                Number("warm_p90_s", Quantile(times.warm, 0.9)),
                Number("warm_max_s", Quantile(times.warm, 1)),
                Number("wrong", static_cast<double>(judgement.wrong)),
                Number("undecided", static_cast<double>(judgement.undecided))};
    const bool counts = queries[q].who != Who::kLibrary ||
                        static_cast<double>(judgement.wrong) <= kWrongMax * count;
    if (counts) medians.Add(queries[q], row);
    if (!counts) row.remark += "; does not count";
    report->Add(std::move(row));
  }
  SetFigures(cell, medians, report);
}

}  // namespace collision::bench
