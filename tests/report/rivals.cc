#include "tests/report/rivals.h"

#include <algorithm>
#include <map>

#include "tests/report/captions.h"
#include "tests/report/chart_rows.h"

namespace collision::report {

using chart::Chart;
namespace {

struct Cell {
  std::optional<double> ours;
  std::optional<double> theirs;
  std::string who;
};

bool Counts(const Row& row) {
  return TextOf(row, "remark").find("does not count") == std::string::npos;
}

void Keep(const Rival& rival, std::optional<Rival>* nearest) {
  if (!*nearest || rival.over_ours < (*nearest)->over_ours) *nearest = rival;
}

}  // namespace

std::optional<Rival> RivalOf(const v1::Results& results, const Contest& contest) {
  std::map<std::string, Cell> cells;
  for (const Row* row : Select(results, contest.experiment, contest.conditions)) {
    const auto seconds = NumberOf(*row, contest.time);
    const std::string who = TextOf(*row, "contestant");
    const auto& variants = contest.variants;
    if (!seconds || *seconds <= 0 || !Counts(*row)) continue;
    if (std::find(variants.begin(), variants.end(), who) != variants.end()) continue;
    Cell& cell = cells[TextOf(*row, contest.cell)];
    if (who == contest.ours) {
      cell.ours = seconds;
    } else if (!cell.theirs || *seconds < *cell.theirs) {
      cell.theirs = seconds, cell.who = who;
    }
  }
  std::optional<Rival> nearest;
  for (const auto& [name, cell] : cells) {
    if (cell.ours && cell.theirs) Keep({cell.who, *cell.theirs / *cell.ours}, &nearest);
  }
  return nearest;
}

std::optional<Rival> ContactRivalOf(const v1::Results& results) {
  std::optional<Rival> nearest;
  const auto all = Select(results, "precision", {{"part", "contact"}, {"who", "!naive"}});
  for (const std::string& motion : TextsOf(all, "motion")) {
    for (const std::string& mesh : TextsOf(all, "mesh")) {
      const auto rows =
          Select(results, "precision",
                 {{"part", "contact"}, {"who", "!naive"}, {"motion", motion}, {"mesh", mesh}});
      const Chart chart =
          ChartOf({}, rows, {{"method"}, "seconds", "width", 1, 1, {"ours"}, "error"});
      for (const EqualError& pair : AtEqualError(chart, kContactFloor)) {
        Keep({pair.who, pair.ratio()}, &nearest);
      }
    }
  }
  return nearest;
}

}  // namespace collision::report
