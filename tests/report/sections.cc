#include "tests/report/sections.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "tests/report/chart_rows.h"
#include "tests/report/load_and_faults.h"
#include "tests/report/text.h"

namespace collision::report {
namespace {

const std::vector<std::string> kOurs = {"ours"};

/// What a file may be called.
std::string IdOf(const std::string& text) {
  std::string id;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain || (!id.empty() && id.back() != '-')) id += plain ? c : '-';
  }
  return id;
}

/// The plots of one part of the benchmark of precision.
struct PrecisionPlots {
  std::string part, id, what, y_label;
};

/// A plot for each motion and pair of bodies.
void AddPrecision(const v1::Results& results, const PrecisionPlots& plots, Section* section) {
  const std::string &part = plots.part, &id = plots.id, &what = plots.what,
                    &y_label = plots.y_label;
  const auto rows = Select(results, "precision", {{"part", part}});
  for (const std::string& motion : TextsOf(rows, "motion")) {
    for (const std::string& mesh :
         TextsOf(Select(results, "precision", {{"part", part}, {"motion", motion}}), "mesh")) {
      Chart chart;
      chart.id = id + "-" + motion + "-" + IdOf(mesh);
      chart.title = what + ", " + motion + ": " + mesh;
      chart.x_label = "time of a query [s]", chart.y_label = y_label;
      chart.caption =
          "Lower and further left is better. Curves of ours: the width that is certified.";
      AddChart(ChartOf(chart,
                       Select(results, "precision",
                              {{"part", part}, {"motion", motion}, {"mesh", mesh}}),
                       {{"method"}, "seconds", "width", 1, 1, kOurs, "error"}),
               section);
    }
  }
}

Section Precision(const v1::Results& results) {
  Section section{"precision", "Error against run time", {}, {}, {}};
  section.paragraphs = {
      "How wide the certified bracket is (ours), or how far from the truth the answer is (theirs), "
      "over the time of one query. A cross on the upper edge: answers that say no where the truth "
      "is yes, or yes where it is no; no time makes up for that."};
  AddPrecision(results, {"precision", "distance", "Distance", "width or error [m]"}, &section);
  AddPrecision(results, {"contact", "contact", "Time of contact", "width or error [s]"}, &section);
  AddWhole(results, "precision", &section);
  return section;
}

Section Budget(const v1::Results& results) {
  Section section{"budget", "The service's budget", {}, {}, {}};
  section.paragraphs = {
      "What the service may spend on a pair in a turn, against how wide its answers are and how "
      "many "
      "pairs stay undecided. Nothing is ever missed for lack of budget: brackets become wider."};
  const auto rows = Select(results, "budget", {});
  const auto chart = [&](const char* id, const char* title, const char* y_label, const char* field,
                         double factor, bool log_y) {
    Chart made;
    made.id = id, made.title = title, made.x_label = "budget [µs]", made.y_label = y_label;
    made.log_y = log_y;
    AddChart(ChartOf(made, rows, {{"kind"}, "budget_us", field, 1, factor, {"a pair", "a step"}}),
             &section);
  };
  chart("budget-begin", "Begin bracket, median", "width [ms]", "begin_width_p50_s", 1e3, true);
  chart("budget-depth", "Separation bracket, median", "width [m]", "separation_width_p50_m", 1,
        true);
  chart("budget-undecided", "Undecided events", "share of all closed [%]", "undecided_share", 100,
        false);
  AddWhole(results, "budget", &section);
  return section;
}

/// A curve for each method from a field that is a list: one value a step.
Chart SeriesChart(Chart chart, const std::vector<const Row*>& rows, const std::string& field) {
  for (const Row* row : rows) {
    const auto found = row->fields().find(field);
    if (found == row->fields().end() || !found->second.has_list_value()) continue;
    Series series;
    series.name = TextOf(*row, "method");
    series.ours = series.name.starts_with("horns and sphere");
    for (const auto& value : found->second.list_value().values()) {
      series.points.push_back(
          {static_cast<double>(series.points.size()), value.number_value(), ""});
    }
    chart.series.push_back(series);
  }
  return chart;
}

/// Without the second loop of ours; whatever its cell, Turk's hash is one contestant.
std::vector<Row> ByTurkOrOurs(const std::vector<const Row*>& rows) {
  std::vector<Row> shown;
  for (const Row* row : rows) {
    const std::string who = TextOf(*row, "contestant");
    if (who.starts_with("local loop")) continue;
    shown.push_back(*row);
    (*shown.back().mutable_fields())["contestant"].set_string_value(
        who.starts_with("Turk") ? "Turk's hash" : "ours");
  }
  return shown;
}

/// A curve for each density.
Chart TurkOverOurs(const v1::Results& results) {
  Chart chart;
  chart.id = "turk-over-ours", chart.title = "Turk's time over ours, until the first collision";
  chart.x_label = "cubes", chart.y_label = "Turk's time over ours", chart.log_y = false;
  chart.caption = "Above 1 ours is faster. The paper states: only just above 1.";
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
  return chart;
}

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
  for (const auto& [density, id] :
       std::vector<std::pair<const char*, const char*>>{{"cubes 0.01 %", "turk-0.01"},
                                                        {"cubes 0.1 %", "turk-0.1"},
                                                        {"cubes 1 %", "turk-1"},
                                                        {"cubes 10 %", "turk-10"}}) {
    Chart chart;
    chart.id = id, chart.title = std::string("Broad phase until the first collision, ") + density;
    chart.x_label = "cubes", chart.y_label = "time of all frames [s]";
    chart.caption =
        "Turk's hash in its best cell; density is the share of the volume that is full.";
    const std::vector<Row> shown = ByTurkOrOurs(Select(results, "turk", {{"scene", density}}));
    std::vector<const Row*> of_density;
    for (const Row& row : shown) of_density.push_back(&row);
    AddChart(ChartOf(chart, of_density, {{"contestant"}, "agents", "seconds", 1, 1, kOurs}),
             &section);
  }
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
  for (const std::string& scene :
       TextsOf(Select(results, "hubbard", {{"part", "both"}}), "scene")) {
    Chart frames;
    frames.id = "frames-" + IdOf(scene), frames.title = "Time of each frame, both phases: " + scene;
    frames.x_label = "frame", frames.y_label = "time [s]", frames.log_x = false;
    frames.caption = "The slowest frames stand out; each is the least of several identical runs.";
    AddChart(SeriesChart(frames, Select(results, "hubbard", {{"part", "both"}, {"scene", scene}}),
                         "frame_series_s"),
             &section);
  }
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

Section Stepping(const v1::Results& results) {
  Section section{"stepping", "What time-stepping misses", {}, {}, {}};
  section.paragraphs = {
      "The naive loop has three weaknesses: what happens between two frames is not seen, every "
      "pair is "
      "tested in every frame, and each test costs as much as exact shapes ask. Here, for each "
      "scene of "
      "./run demo, a loop of 60 frames a second is run over the same motion."};
  AddTable(TableOf("Each scene at 60 Hz", Select(results, "stepping", {{"part", "scene"}}),
                   {{"scene", "scene"},
                    {"agents", "agents"},
                    {"contacts", "true contacts"},
                    {"missed", "missed at 60 Hz"},
                    {"missed_ours", "missed by ours"},
                    {"late_s", "seen late by, median"},
                    {"pair_tests", "pair tests"},
                    {"pair_tests_ours", "pairs ours looked at"},
                    {"seconds_per_pair_s", "a pair test"}}),
           &section);
  Chart shrunk;
  shrunk.id = "satellites", shrunk.title = "The satellites' contact, made shorter";
  shrunk.x_label = "length of the contact [s]", shrunk.y_label = "found (1) or missed (0)";
  shrunk.log_y = false;
  shrunk.caption =
      "Keep-out spheres shrunk until a loop of 60 frames a second misses their meeting.";
  AddChart(ChartOf(shrunk, Select(results, "stepping", {{"part", "shrunk"}}),
                   {{"method"}, "contact_s", "found", 1, 1, kOurs}),
           &section);
  AddWhole(results, "stepping", &section);
  return section;
}

/// From here on the fixed costs of a query are not felt.
constexpr double kGrowthFrom = 1000;

/// The exponent of a least-squares line through the logarithms is put behind the series' name.
void NameGrowth(Chart* chart) {
  for (Series& series : chart->series) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Point& point : series.points) {
      if (!point.y || point.x < kGrowthFrom || *point.y <= 0) continue;
      const double a = std::log(point.x), b = std::log(*point.y);
      n += 1, x += a, y += b, xx += a * a, xy += a * b;
    }
    if (n < 2) continue;
    char text[24];
    std::snprintf(text, sizeof text, " (N^%.2f)", (n * xy - x * y) / (n * xx - x * x));
    series.name += text;
  }
}

Section BroadPhase(const v1::Results& results) {
  Section section{"broad-phase", "Broad phase and streaming", {}, {}, {}};
  section.paragraphs = {
      "The earliest meeting of all, with every bound new, and with one bound new "
      "at a time; ours includes certification and taking over the caller's data."};
  for (const char* hit : {"at_once", "half", "never"}) {
    Chart chart;
    chart.id = std::string("scratch-") + hit;
    chart.title = std::string("From scratch, first hit: ") + hit;
    chart.x_label = "agents", chart.y_label = "time of a query [s]";
    AddChart(ChartOf(chart,
                     Select(results, "broad-phase",
                            {{"part", "scratch"}, {"scene", std::string("uniform ") + hit}}),
                     {{"contestant"}, "agents", "seconds", 1, 1, {"chosen"}}),
             &section);
  }
  Chart streaming;
  streaming.id = "streaming", streaming.title = "One bound renewed, earliest of all kept current";
  streaming.x_label = "agents", streaming.y_label = "time of an update [s]";
  AddChart(ChartOf(streaming, Select(results, "streaming", {{"part", "incremental"}}),
                   {{"contestant"}, "agents", "seconds", 1, 1, {"chosen"}}),
           &section);
  for (Chart& chart : section.charts) NameGrowth(&chart);
  for (const char* name : {"broad-phase", "streaming", "special-scenes"}) {
    AddWhole(results, name, &section);
  }
  return section;
}

Section Service(const v1::Results& results) {
  Section section{"service", "The service beside raw DDS", {}, {}, {}};
  section.paragraphs = {
      "From a simulator's update to the event it causes, beside a daemon of the same bus code that "
      "does nothing but answer; and how many messages a fixed stream would need for the same."};
  const auto rows = Select(results, "service", {{"part", "latency"}});
  const auto beside = [&](const char* id, const char* title, const char* y_label,
                          const char* field) {
    Chart chart;
    chart.id = id, chart.title = title, chart.x_label = "agents", chart.y_label = y_label;
    AddChart(ChartOf(chart, rows, {{"contestant"}, "agents", field, 1, 1, kOurs}), &section);
  };
  beside("service-event", "Update to event", "median [s]", "event_p50_s");
  beside("service-event-p99", "Update to event, the slowest hundredth", "p99 [s]", "event_p99_s");
  beside("service-throughput", "Updates a second", "updates a second", "updates_per_s");
  for (const auto& [sweep, field, label] :
       {std::array<const char*, 3>{"acceleration", "acceleration_max_m_s2",
                                   "greatest acceleration [m/s²]"},
        std::array<const char*, 3>{"spacing", "spacing_m", "distance of neighbours [m]"},
        std::array<const char*, 3>{"speed", "speed_m_s", "speed [m/s]"}}) {
    Chart saved;
    saved.id = std::string("messages-") + sweep;
    saved.title = std::string("States of a fixed stream for one of ours, over ") + sweep;
    saved.x_label = label, saved.y_label = "ratio";
    AddChart(ChartOf(saved,
                     Select(results, "service",
                            {{"part", "messages"}, {"sweep", sweep + std::string("=*")}}),
                     {{"part"}, field, "ratio"}),
             &section);
  }
  AddWhole(results, "service", &section);
  return section;
}

Section LeftOut(const v1::Results& results) {
  Section section{"left-out", "What was left out", {}, {}, {}};
  section.paragraphs = {
      "Each optional part on and off in each scene: what it costs, and what the scene profile "
      "chose. In "
      "counted work the choice is to lie within a tenth of the best one made by hand."};
  AddTable(TableOf("What the profile chose", Select(results, "left-out", {{"part", "profile"}}),
                   {{"scene", "scene"},
                    {"agents", "agents"},
                    {"chosen", "chosen"},
                    {"units", "units of work"},
                    {"best", "best by hand"},
                    {"best_units", "its units"},
                    {"ratio", "ratio"},
                    {"left_out", "left out"}}),
           &section);
  AddWhole(results, "left-out", &section);
  return section;
}

Section Stress(const v1::Results& results) {
  Section section{"stress", "Stiff and extreme", {}, {}, {}};
  section.paragraphs = {"Each case with what is promised and what was measured (./run stress)."};
  AddTable(TableOf("", Select(results, "stress", {}),
                   {{"group", "group"},
                    {"name", "case"},
                    {"promised", "promised"},
                    {"measured", "measured"},
                    {"kept", "kept"}}),
           &section);
  AddWhole(results, "stress", &section);
  return section;
}

Section Trust(const v1::Results& results) {
  Section section{"trust", "Same bits, fuzzing, mutants", {}, {}, {}};
  section.paragraphs = {
      "The event log's hash over compilers, optimisation and vectors (./run same-bits); what "
      "fuzzing "
      "ran (./run fuzz); and each safety margin broken on purpose, with the test that noticed it "
      "(./run "
      "mutants). These are of their last runs."};
  for (const char* name : {"same-bits", "mutants", "fuzz"}) AddWhole(results, name, &section);
  for (Table& table : section.tables)
    table.folded = table.title.find("figures") == std::string::npos;
  return section;
}

}  // namespace

std::vector<Section> SectionsOf(const v1::Results& results) {
  return {Precision(results),     Budget(results),  Hubbard(results), Stepping(results),
          BroadPhase(results),    Service(results), LeftOut(results), Stress(results),
          LoadAndFaults(results), Trust(results)};
}

std::vector<MeasuredPlot> MeasuredPlots() {
  return {
      {"distance-translation-homer-500",
       "Error against run time: the width of our certified brackets, the error of the libraries"},
      {"budget-begin",
       "The service: the budget of one evaluation of a pair against the begin bracket"},
      {"scratch-half", "Broad phase: the earliest meeting of all from scratch"}};
}

}  // namespace collision::report
