#include "tests/report/sections.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "tests/report/captions.h"
#include "tests/report/chart_rows.h"
#include "tests/report/contestants.h"
#include "tests/report/hubbard.h"
#include "tests/report/load_and_faults.h"
#include "tests/report/text.h"

namespace collision::report {

using chart::Chart;
using chart::Point;
using chart::Series;
namespace {

const std::vector<std::string> kOurs = {"ours"};

/// The plots of one part of the benchmark of precision.
struct PrecisionPlots {
  std::string part, id, what, y_label, unit;
  double floor;  ///< Errors below it are rounding.
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
      chart = ChartOf(
          chart, Select(results, "precision", {{"part", part}, {"motion", motion}, {"mesh", mesh}}),
          {{"method"}, "seconds", "width", 1, 1, kOurs, "error"});
      chart.caption =
          "Lower and further left is better. Curves of ours: the width that is certified. " +
          MostExact(chart, plots.floor, plots.unit);
      AddChart(chart, section);
    }
  }
}

Section Precision(const v1::Results& results) {
  Section section{"precision", "Error against run time", {}, {}, {}};
  section.paragraphs = {
      "How wide the certified bracket is (ours), or how far from the truth the answer is (theirs), "
      "over the time of one query. A cross on the upper edge: answers that say no where the truth "
      "is yes, or yes where it is no; no time makes up for that."};
  AddPrecision(results,
               {"precision", "distance", "Distance", "width or error [m]", "m", kDistanceFloor},
               &section);
  AddPrecision(results,
               {"contact", "contact", "Time of contact", "width or error [s]", "s", kContactFloor},
               &section);
  AddWhole(results, "precision", &section);
  return section;
}

Section Budget(const v1::Results& results) {
  Section section{"budget", "The service's budget", {}, {}, {}};
  section.paragraphs = {
      "What the service may spend on a pair in a turn, against how wide its answers are and how "
      "many "
      "pairs stay undecided. Nothing is ever missed for lack of budget: brackets become wider."};
  const std::vector<Row> rows = Renamed(Select(results, "budget", {}), "kind",
                                        [](const std::string& kind) { return "ours: " + kind; });
  const auto chart = [&](const char* id, const char* title, const char* y_label, const char* field,
                         double factor, const char* unit) {
    Chart made;
    made.id = id, made.title = title, made.x_label = "budget [µs]", made.y_label = y_label;
    made.log_y = std::string(unit) != "%";
    made = ChartOf(made, Pointers(rows), {{"kind"}, "budget_us", field, 1, factor, kOurs});
    made.caption = "More time, narrower answers; from the least budget to the greatest: " +
                   FirstToLast(made, unit);
    AddChart(made, &section);
  };
  chart("budget-begin", "Begin bracket, median", "width [ms]", "begin_width_p50_s", 1e3, "ms");
  chart("budget-depth", "Separation bracket, median", "width [m]", "separation_width_p50_m", 1,
        "m");
  chart("budget-undecided", "Undecided events", "share of all closed [%]", "undecided_share", 100,
        "%");
  AddWhole(results, "budget", &section);
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
  const std::vector<Row> rows =
      Renamed(Select(results, "stepping", {{"part", "shrunk"}}), "method",
              [](const std::string& m) { return m == "60 Hz" ? "stepping at 60 Hz" : m; });
  shrunk = ChartOf(shrunk, Pointers(rows), {{"method"}, "contact_s", "found", 1, 1, kOurs});
  shrunk.caption =
      "Keep-out spheres shrunk until a loop of 60 frames a second misses their meeting: contacts "
      "shorter than a frame are found by chance.";
  AddChart(shrunk, &section);
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

/// Ours is what the scene's profile chooses; the other methods of ours are variants of it.
std::string OursByName(const std::string& contestant) {
  if (contestant == "chosen") return "ours";
  const bool variant =
      contestant == "all-pairs" || contestant == "face-sweep" || contestant == "spatial-index";
  return variant ? "ours: " + contestant : contestant;
}

/// Time against agents, a curve for each contestant; the exponents stand behind their names.
void AddGrowth(Chart chart, const std::vector<const Row*>& measured, Section* section) {
  const std::vector<Row> rows = Renamed(measured, "contestant", OursByName);
  chart = ChartOf(chart, Pointers(rows), {{"contestant"}, "agents", "seconds", 1, 1, {"ours"}});
  for (Series& series : chart.series) series.thick = series.name == "ours";
  chart.caption = "Lower is better; N^x is how the time grows with the agents. " +
                  TimesAtTheEnd(chart, "agents");
  DrawByContestant(&chart);
  NameGrowth(&chart);
  AddChart(chart, section);
}

Section BroadPhase(const v1::Results& results) {
  Section section{"broad-phase", "Broad phase and streaming", {}, {}, {}};
  section.paragraphs = {
      "The earliest meeting of all, with every bound new, and with one bound new "
      "at a time; ours includes certification and taking over the caller's data. Ours is what the "
      "scene's profile chooses: \"chosen\" in the tables."};
  for (const char* hit : {"at_once", "half", "never"}) {
    Chart chart;
    chart.id = std::string("scratch-") + hit;
    chart.title = std::string("From scratch, first hit: ") + hit;
    chart.x_label = "agents", chart.y_label = "time of a query [s]";
    AddGrowth(chart,
              Select(results, "broad-phase",
                     {{"part", "scratch"}, {"scene", std::string("uniform ") + hit}}),
              &section);
  }
  Chart streaming;
  streaming.id = "streaming", streaming.title = "One bound renewed, earliest of all kept current";
  streaming.x_label = "agents", streaming.y_label = "time of an update [s]";
  AddGrowth(streaming, Select(results, "streaming", {{"part", "incremental"}}), &section);
  for (const char* name : {"broad-phase", "streaming", "special-scenes"}) {
    AddWhole(results, name, &section);
  }
  return section;
}

Section Service(const v1::Results& results) {
  Section section{"service", "The service beside raw DDS", {}, {}, {}};
  section.paragraphs = {
      "From a simulator's update to the event it causes, beside a daemon of the same bus code that "
      "does nothing but answer (\"network\" in the tables); and how many messages a fixed stream "
      "would need for the same."};
  const std::vector<Row> rows =
      Renamed(Select(results, "service", {{"part", "latency"}}), "contestant",
              [](const std::string& who) { return who == "network" ? "no-op program" : who; });
  const auto beside = [&](const char* id, const char* title, const char* y_label, const char* field,
                          bool times) {
    Chart chart;
    chart.id = id, chart.title = title, chart.x_label = "agents", chart.y_label = y_label;
    chart = ChartOf(chart, Pointers(rows), {{"contestant"}, "agents", field, 1, 1, kOurs});
    chart.caption =
        "The no-op program does nothing but answer, so nothing can be faster on this network. " +
        (times ? TimesAtTheEnd(chart, "agents")
               : RatesAtTheEnd(chart, "agents", "updates a second"));
    AddChart(chart, &section);
  };
  beside("service-event", "Update to event", "median [s]", "event_p50_s", true);
  beside("service-event-p99", "Update to event, the slowest hundredth", "p99 [s]", "event_p99_s",
         true);
  beside("service-throughput", "Updates a second", "updates a second", "updates_per_s", false);
  for (const auto& [sweep, field, label] :
       {std::array<const char*, 3>{"acceleration", "acceleration_max_m_s2",
                                   "greatest acceleration [m/s²]"},
        std::array<const char*, 3>{"spacing", "spacing_m", "distance of neighbours [m]"},
        std::array<const char*, 3>{"speed", "speed_m_s", "speed [m/s]"}}) {
    Chart saved;
    saved.id = std::string("messages-") + sweep;
    saved.title = std::string("States of a fixed stream for one of ours, over ") + sweep;
    saved.x_label = label, saved.y_label = "ratio";
    saved = ChartOf(
        saved,
        Select(results, "service", {{"part", "messages"}, {"sweep", sweep + std::string("=*")}}),
        {{"part"}, field, "ratio"});
    for (Series& series : saved.series) series.name = "ours", series.thick = true;
    saved.caption =
        "How many states a stream of 60 a second sends for each one that ours asks for; from left "
        "to right: " +
        FirstToLast(saved, "");
    AddChart(saved, &section);
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

Section Gateway(const v1::Results& results) {
  Section section{"gateway", "The gateway", {}, {}, {}};
  section.paragraphs = {
      "Processor time of collision-gateway while a swarm in real time changes ten times a second, "
      "with so many viewers of its page; and sizes of a recorded world as one page and as an MCAP "
      "file."};
  const auto costs = Select(results, "gateway", {{"part", "cost"}});
  AddTable(TableOf("", costs,
                   {{"agents", "agents"},
                    {"viewers", "viewers"},
                    {"cores", "cores"},
                    {"updates_a_second_least", "updates a second, of the slowest viewer"}}),
           &section);
  AddWhole(results, "gateway", &section);
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
          LoadAndFaults(results), Gateway(results), Trust(results)};
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
