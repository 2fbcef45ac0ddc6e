#include "tests/report/hubbard.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/report/captions.h"
#include "tests/report/chart_rows.h"
#include "tests/report/rows.h"

namespace collision::report {

using chart::Chart;
using chart::Point;
using chart::Series;
namespace {

const std::vector<std::string> kOurs = {"ours"};

/// A curve for each method from a field that is a list: one value a step.
Chart SeriesChart(Chart chart, const std::vector<const Row*>& rows, const std::string& field) {
  for (const Row* row : rows) {
    const auto found = row->fields().find(field);
    if (found == row->fields().end() || !found->second.has_list_value()) continue;
    Series series;
    const std::string method = TextOf(*row, "method");
    series.name = method.starts_with("horns") ? "ours: " + method : method;
    series.thick = method.starts_with("horns and sphere");
    for (const auto& value : found->second.list_value().values()) {
      series.points.push_back(
          {static_cast<double>(series.points.size()), value.number_value(), ""});
    }
    chart.series.push_back(series);
  }
  return chart;
}

/// Whatever its cell, Turk's hash is one contestant.
std::string TurkOrOurs(const std::string& contestant) {
  return contestant.starts_with("Turk") ? "Turk's hash" : "ours";
}

/// A curve for each density.
Chart TurkOverOurs(const v1::Results& results) {
  Chart chart;
  chart.id = "turk-over-ours", chart.title = "Turk's time over ours, until the first collision";
  chart.x_label = "cubes", chart.y_label = "Turk's time over ours", chart.log_y = false;
  for (const std::string& scene : TextsOf(Select(results, "turk", {}), "scene")) {
    Series series;
    series.name = scene;
    for (const Row* ours : Select(results, "turk", {{"scene", scene}, {"contestant", "window*"}})) {
      const auto count = NumberOf(*ours, "agents"), own = NumberOf(*ours, "seconds");
      for (const Row* turk : Select(results, "turk", {{"scene", scene}, {"contestant", "Turk*"}})) {
        const auto theirs = NumberOf(*turk, "seconds");
        if (!count || !own || !theirs || NumberOf(*turk, "agents") != count) continue;
        series.points.push_back({*count, *theirs / *own, ""});
      }
    }
    std::sort(series.points.begin(), series.points.end(),
              [](const Point& a, const Point& b) { return a.x < b.x; });
    if (!series.points.empty()) chart.series.push_back(series);
  }
  chart.caption =
      "Above 1 ours is faster. The paper states: only just above 1. From the fewest to "
      "the most cubes: " +
      FirstToLast(chart, "");
  return chart;
}

/// A plot for each density.
void AddTurk(const v1::Results& results, Section* section) {
  for (const auto& [density, id] :
       std::vector<std::pair<const char*, const char*>>{{"cubes 0.01 %", "turk-0.01"},
                                                        {"cubes 0.1 %", "turk-0.1"},
                                                        {"cubes 1 %", "turk-1"},
                                                        {"cubes 10 %", "turk-10"}}) {
    Chart chart;
    chart.id = id, chart.title = std::string("Broad phase until the first collision, ") + density;
    chart.x_label = "cubes", chart.y_label = "time of all frames [s]";
    const std::vector<Row> shown = Renamed(
        Select(results, "turk", {{"scene", density}, {"contestant", "!local loop, chosen"}}),
        "contestant", TurkOrOurs);
    chart = ChartOf(chart, Pointers(shown), {{"contestant"}, "agents", "seconds", 1, 1, kOurs});
    chart.caption =
        "Turk's hash in its best cell; density is the share of the volume that is full. " +
        TimesAtTheEnd(chart, "cubes");
    AddChart(chart, section);
  }
}

/// A plot for each scene, with a curve of all frames for each method.
void AddFrames(const v1::Results& results, Section* section) {
  for (const std::string& scene :
       TextsOf(Select(results, "hubbard", {{"part", "both"}}), "scene")) {
    Chart frames;
    frames.id = "frames-" + IdOf(scene), frames.title = "Time of each frame, both phases: " + scene;
    frames.x_label = "frame", frames.y_label = "time [s]", frames.log_x = false;
    frames = SeriesChart(frames, Select(results, "hubbard", {{"part", "both"}, {"scene", scene}}),
                         "frame_series_s");
    frames.caption = "The slowest frames stand out; each is the least of several identical runs. " +
                     Slowest(frames);
    AddChart(frames, section);
  }
}

}  // namespace

Section Hubbard(const v1::Results& results) {
  Section section{"hubbard", "Hubbard's experiments", {}, {}, {}};
  section.paragraphs = {
      "The experiments of the paper, made anew with its baselines. It states: in the broad phase, "
      "Turk's time over ours is only just above 1; our slowest frames are slower than Turk's, "
      "though "
      "rarely; both phases together are 5 to 7 times faster than Turk's hash with BSP trees. No "
      "other "
      "number of it is quoted here."};
  AddChart(TurkOverOurs(results), &section);
  const auto rows = Select(results, "turk", {{"contestant", "!local loop, chosen"}});
  AddTurk(results, &section);
  AddTable(TableOf("Each configuration, with its slowest frame", rows,
                   {{"scene", "scene"},
                    {"agents", "cubes"},
                    {"contestant", "who"},
                    {"seconds", "all frames"},
                    {"slowest_frame_s", "slowest frame"},
                    {"frames", "frames"}}),
           &section);
  AddTable(TableOf("The narrow phase alone, the spaceship simulator's pair tests",
                   Select(results, "hubbard", {{"part", "narrow"}}),
                   {{"scene", "scene"},
                    {"method", "method"},
                    {"tests", "pair tests"},
                    {"seconds", "one, median"},
                    {"slowest_s", "slowest"},
                    {"wrong", "wrong"}}),
           &section);
  AddFrames(results, &section);
  AddTable(TableOf("Both phases together in the spaceship simulator",
                   Select(results, "hubbard", {{"part", "both"}}),
                   {{"scene", "scene"},
                    {"method", "method"},
                    {"total_s", "all frames"},
                    {"frame_p50_s", "median frame"},
                    {"frame_p99_s", "p99"},
                    {"slowest_frame_s", "slowest frame"},
                    {"contacts", "contacts"},
                    {"frames_that_differ", "frames that differ"}}),
           &section);
  AddWhole(results, "turk", &section);
  AddWhole(results, "hubbard", &section);
  return section;
}

}  // namespace collision::report
