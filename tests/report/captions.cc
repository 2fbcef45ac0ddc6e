#include "tests/report/captions.h"

#include <algorithm>

#include "tests/report/contestants.h"
#include "tests/report/text.h"

namespace collision::report {

using chart::Chart;
using chart::Point;
using chart::Series;
namespace {

bool IsOurs(const Series& series) { return ContestantOf(series.name) == "ours"; }

/// A point of a curve and whose it is.
struct Found {
  std::string who;
  double y = 0;
};

std::optional<double> HeightAt(const Series& series, double x) {
  for (const Point& point : series.points) {
    if (point.x == x) return point.y;
  }
  return std::nullopt;
}

/// Ours is the thick curve; variants of ours compete with nobody.
std::optional<double> OursAt(const Chart& chart, double x) {
  for (const Series& series : chart.series) {
    if (IsOurs(series) && series.thick) return HeightAt(series, x);
  }
  return std::nullopt;
}

std::optional<Found> BestOtherAt(const Chart& chart, double x, bool least) {
  std::optional<Found> best;
  for (const Series& series : chart.series) {
    const auto y = HeightAt(series, x);
    if (IsOurs(series) || !y) continue;
    if (!best || (least ? *y < best->y : *y > best->y))
      best = Found{WithoutGrowth(series.name), *y};
  }
  return best;
}

struct End {
  double x = 0, ours = 0;
  Found other;
};

/// At the greatest x at which both are there.
std::optional<End> EndOf(const Chart& chart, bool least) {
  std::optional<End> end;
  for (const Series& series : chart.series) {
    for (const Point& point : series.points) {
      if (end && point.x <= end->x) continue;
      const auto ours = OursAt(chart, point.x);
      const auto other = BestOtherAt(chart, point.x, least);
      if (ours && other) end = End{point.x, *ours, *other};
    }
  }
  return end;
}

std::string Names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : "; ") + name;
  return text;
}

}  // namespace

std::vector<EqualError> AtEqualError(const Chart& chart, double floor) {
  std::vector<EqualError> all;
  for (const Series& peer : chart.series) {
    if (IsOurs(peer)) continue;
    for (const Point& theirs : peer.points) {
      if (!theirs.y) continue;
      const double error = std::max(*theirs.y, floor);
      std::optional<double> ours;
      for (const Series& series : chart.series) {
        if (!IsOurs(series)) continue;
        for (const Point& own : series.points) {
          if (own.y && *own.y <= error) ours = std::min(ours.value_or(own.x), own.x);
        }
      }
      if (ours) all.push_back({peer.name, error, theirs.x, *ours});
    }
  }
  return all;
}

std::string MostExact(const Chart& chart, double floor, const std::string& unit) {
  std::string text;
  const std::vector<EqualError> all = AtEqualError(chart, floor);
  const auto best = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.error < b.error || (a.error == b.error && a.theirs_s < b.theirs_s);
  });
  if (best != all.end()) {
    text = best->who + " comes within " + Rounded(best->error) + " " + unit + " in " +
           Duration(best->theirs_s) + "; ours certifies as much in " + Duration(best->ours_s) + ".";
  }
  std::vector<std::string> wrong;
  for (const Series& series : chart.series) {
    const bool crossed = std::any_of(series.points.begin(), series.points.end(),
                                     [](const Point& point) { return !point.y; });
    if (crossed) wrong.push_back(series.name);
  }
  if (!wrong.empty()) {
    text +=
        (text.empty() ? "" : " ") + std::string("Wrong at times (crosses): ") + Names(wrong) + ".";
  }
  return text;
}

std::string TimesAtTheEnd(const Chart& chart, const std::string& of_x) {
  const auto end = EndOf(chart, true);
  if (!end) return "";
  const double ratio = end->other.y / end->ours;
  return "With " + Grouped(end->x) + " " + of_x + " ours takes " + Duration(end->ours) +
         " and the best other, " + end->other.who + ", " + Duration(end->other.y) + ": " +
         (ratio >= 1 ? "that takes " + Rounded(ratio) : "ours takes " + Rounded(1 / ratio)) +
         " times as long.";
}

std::string RatesAtTheEnd(const Chart& chart, const std::string& of_x, const std::string& of_y) {
  const auto end = EndOf(chart, false);
  if (!end) return "";
  return "With " + Grouped(end->x) + " " + of_x + " ours manages " + Rounded(end->ours) + " " +
         of_y + " and the " + end->other.who + " " + Rounded(end->other.y) + ": ours reaches " +
         Rounded(end->ours / end->other.y) + " of it.";
}

std::string Slowest(const Chart& chart) {
  std::string text;
  for (const Series& series : chart.series) {
    double slowest = 0;
    for (const Point& point : series.points) slowest = std::max(slowest, point.y.value_or(0));
    text += (text.empty() ? "The slowest frame of each: " : "; ") + series.name + " " +
            Duration(slowest);
  }
  return text.empty() ? "" : text + ".";
}

std::string FirstToLast(const Chart& chart, const std::string& unit) {
  std::string text;
  for (const Series& series : chart.series) {
    if (series.points.empty()) continue;
    const auto &first = series.points.front(), &last = series.points.back();
    if (!first.y || !last.y) continue;
    text += (text.empty() ? "" : "; ") + (chart.series.size() > 1 ? series.name + " " : "") +
            Rounded(*first.y) + " to " + Rounded(*last.y) + (unit.empty() ? "" : " " + unit);
  }
  return text.empty() ? "not measured." : text + ".";
}

}  // namespace collision::report
