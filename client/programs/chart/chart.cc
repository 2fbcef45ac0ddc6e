#include "client/programs/chart/chart.h"

#include <algorithm>
#include <cstdio>

namespace collision::chart {
namespace {

bool Has(const std::vector<Look>& taken, Colour colour) {
  return std::any_of(taken.begin(), taken.end(), [&](const Look& l) { return l.colour == colour; });
}

bool Has(const std::vector<Look>& taken, Mark mark) {
  return std::any_of(taken.begin(), taken.end(), [&](const Look& l) { return l.mark == mark; });
}

bool Has(const std::vector<Look>& taken, Colour colour, Mark mark) {
  return std::any_of(taken.begin(), taken.end(),
                     [&](const Look& l) { return l.colour == colour && l.mark == mark; });
}

/// The name's own look, or the next with a colour and a mark that are free; failing that, with a
/// pair of both that is free; failing that, its own.
Look FreeLook(const std::string& name, const std::vector<Look>& taken) {
  const Look own = LookOf(name);
  const auto at = static_cast<std::size_t>(own.colour);
  const auto mark_at = static_cast<std::size_t>(
      std::find(kOpenMarks.begin(), kOpenMarks.end(), own.mark) - kOpenMarks.begin());
  for (const bool both_free : {true, false}) {
    for (std::size_t i = 0; i < kColours * kOpenMarks.size(); ++i) {
      const auto colour = static_cast<Colour>((at + i / kOpenMarks.size()) % kColours);
      const Mark mark = kOpenMarks[(mark_at + i) % kOpenMarks.size()];
      if (Has(taken, colour, mark)) continue;
      if (!both_free || (!Has(taken, colour) && !Has(taken, mark))) return {colour, mark, 0};
    }
  }
  return own;
}

}  // namespace

void GiveLooks(Chart* chart) {
  std::vector<Look> taken;
  std::vector<Series*> without;
  for (Series& series : chart->series) {
    if (series.look) taken.push_back(*series.look);
    if (!series.look) without.push_back(&series);
  }
  std::sort(without.begin(), without.end(),
            [](const Series* a, const Series* b) { return a->name < b->name; });
  for (Series* series : without) {
    series->look = FreeLook(series->name, taken);
    taken.push_back(*series->look);
  }
}

std::string Csv(const Chart& chart) {
  std::string text = "series," + CsvCell(chart.x_label) + "," + CsvCell(chart.y_label) + ",note\n";
  for (const Series& series : chart.series) {
    for (const Point& point : series.points) {
      char x[40], y[40] = "inf";
      std::snprintf(x, sizeof x, "%.15g", point.x);
      if (point.y) std::snprintf(y, sizeof y, "%.15g", *point.y);
      text += CsvCell(series.name) + "," + x + "," + y + "," + CsvCell(point.note) + "\n";
    }
  }
  return text;
}

std::string CsvCell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace collision::chart
