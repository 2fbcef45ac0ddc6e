#include "tests/report/load_and_faults.h"

#include <string>
#include <utility>
#include <vector>

#include "tests/report/chart_rows.h"
#include "tests/report/rows.h"
#include "tests/report/text.h"

namespace collision::report {

using chart::Chart;
using chart::Series;
namespace {

const std::vector<std::string> kPromised = {"what", "promised", "measured", "command", "kept"};

const char* YesOrNo(bool kept) { return kept ? "yes" : "NO"; }

/// A figure, and the greatest value with which its promise is kept.
struct Bound {
  const char *what, *promised, *experiment, *figure;
  double at_most;
  const char* command;
};

constexpr Bound kBounds[] = {
    {"update to event beside 363 overlapping meshes of another simulator, over alone: median",
     "within twice", "service", "crowd_event_p50_ratio", 2, "./run bench service --only crowd"},
    {"the same, the slowest hundredth", "within twice", "service", "crowd_event_p99_ratio", 2,
     "./run bench service --only crowd"},
    {"update to event in a secured world (sign), over one that is not: median", "at most half more",
     "service", "secured_event_p50_ratio_sign", 1.5, "./run bench service --only security"},
    {"update to event with the flight recorder, over without: median", "at most a tenth more",
     "service", "recorder_event_p50_ratio", 1.1, "./run bench service --only recorder"},
    {"a step of 1,000 agents at rest in a lattice, over a jittered one", "at most a quarter more",
     "service", "lattice_step_ratio_1000", 1.25, "./run bench service --only at-rest"},
    {"the same, 10,000 agents", "at most a quarter more", "service", "lattice_step_ratio_10000",
     1.25, "./run bench service --only at-rest"},
};

void AddBounds(const v1::Results& results, Table* table) {
  for (const Bound& bound : kBounds) {
    if (FindExperiment(results, bound.experiment) == nullptr) continue;
    const auto value = FigureOf(results, bound.experiment, bound.figure);
    table->rows.push_back({bound.what, bound.promised, value ? Short(*value) : "not measured",
                           bound.command, YesOrNo(value && *value <= bound.at_most)});
  }
}

std::string CommandOf(const std::string& experiment, const Row& row) {
  return "./run " + experiment + " --only " + TextOf(row, "group") + "/" + TextOf(row, "name");
}

std::string Milliseconds(const Row& row, const std::string& field) {
  return Duration(1e-3 * NumberOf(row, field).value_or(0));
}

/// How long take-overs took, and whether contacts were told as they should be meanwhile. A case
/// that broke before it could tell has its own words.
void AddTakeOvers(const v1::Results& results, Table* table) {
  for (const Row* row : Select(results, "network", {{"group", "take-over"}})) {
    const std::string what = "the serving one of two services is " + TextOf(*row, "name");
    const std::string command = CommandOf("network", *row);
    const auto count = NumberOf(*row, "take_overs");
    const auto within = NumberOf(*row, "within_lease_and_50_ms");
    if (!count || !within) {
      table->rows.push_back(
          {what, TextOf(*row, "promised"), TextOf(*row, "measured"), command, "NO"});
      continue;
    }
    const bool told = TextOf(*row, "kept") == "yes";
    table->rows.push_back(
        {what,
         "the other one is heard within the lease + 50 ms, " + Milliseconds(*row, "promised_ms"),
         "p50 " + Milliseconds(*row, "p50_ms") + ", p90 " + Milliseconds(*row, "p90_ms") +
             ", at most " + Milliseconds(*row, "max_ms") + "; " + Short(*within) + " of " +
             Short(*count) + " in time",
         command, YesOrNo(told && *within >= *count)});
    table->rows.push_back(
        {what + ", " + Short(*count) + " times in a row", "each contact is told once, in its order",
         told ? "it is" : "not each of " + TextOf(*row, "contacts_told"), command, YesOrNo(told)});
  }
}

/// "The longest: killed 101 ms."
std::string Longest(const Chart& chart) {
  std::string text;
  for (const Series& series : chart.series) {
    if (series.points.empty() || series.name.starts_with("promised")) continue;
    text += (text.empty() ? "The longest: " : "; ") + series.name + " " +
            Rounded(series.points.back().x) + " ms";
  }
  return text.empty() ? "" : text + ".";
}

/// The share of take-overs that were heard of in so long, a curve for each fault.
Chart TakeOverChart(const v1::Results& results) {
  Chart chart;
  chart.id = "take-over", chart.title = "From a fault of the service to its successor";
  chart.x_label = "from the fault to the first status of the other service [ms]";
  chart.y_label = "take-overs heard of by then [%]";
  chart.log_y = false;
  double promised_ms = 0;
  for (const Row* row : Select(results, "network", {{"group", "take-over"}})) {
    const auto found = row->fields().find("take_over_ms");
    if (found == row->fields().end()) continue;
    promised_ms = NumberOf(*row, "promised_ms").value_or(0);
    Series series;
    series.name = TextOf(*row, "name");
    const auto& sorted_ms = found->second.list_value().values();
    for (int i = 0; i < sorted_ms.size(); ++i) {
      series.points.push_back(
          {sorted_ms[i].number_value(), 100.0 * (i + 1) / sorted_ms.size(), ""});
    }
    chart.series.push_back(series);
  }
  if (promised_ms > 0) {
    Series promise;
    promise.name = "promised: the lease + 50 ms";
    promise.points = {{promised_ms, 0.0, ""}, {promised_ms, 100.0, ""}};
    chart.series.push_back(promise);
  }
  chart.caption =
      "Real programs, each on a host of its own; left of the upright line is what is promised. " +
      Longest(chart);
  return chart;
}

/// A number of a case, and the words behind it.
struct Counted {
  const char *field, *words;
  bool even_if_none = true;
};

/// In a few words where the case is kept; otherwise all, with what failed.
std::string MeasuredOf(const Row& row, const std::vector<Counted>& counted) {
  std::string text;
  if (TextOf(row, "kept") == "yes") {
    for (const auto& [field, words, even_if_none] : counted) {
      const auto number = NumberOf(row, field);
      if (number && (*number > 0 || even_if_none))
        text += (text.empty() ? "" : ", ") + Short(*number) + " " + words;
    }
  }
  return text.empty() ? TextOf(row, "measured") : text;
}

/// What is done, what is promised and what was measured in each case; take-overs have a table of
/// their own.
Table CasesTable(const v1::Results& results, const std::string& experiment,
                 const std::string& title, const std::vector<Counted>& counted) {
  Table table{title, {"fault", "promised", "measured", "command", "kept"}, {}};
  for (const Row* row : Select(results, experiment, {{"group", "!take-over"}})) {
    table.rows.push_back({TextOf(*row, "fault"), TextOf(*row, "promised"),
                          MeasuredOf(*row, counted), CommandOf(experiment, *row),
                          TextOf(*row, "kept")});
  }
  return table;
}

/// Alone, beside, and the ratio.
std::string AloneBeside(const Row& row, const std::string& what) {
  if (!NumberOf(row, what + "_alone_ms")) return "";
  return Milliseconds(row, what + "_alone_ms") + ", " + Milliseconds(row, what + "_beside_ms") +
         " (× " + TextOf(row, what + "_times") + ")";
}

Table BadClientsTable(const v1::Results& results) {
  Table table{"A bad client beside an honest one: what the honest one is served alone, and beside",
              {"the bad one", "answer, median", "p99", "update to event, median", "p99",
               "memory of the service", "of what is allowed", "command", "kept"},
              {}};
  for (const Row* row : Select(results, "soak", {{"group", "beside"}})) {
    table.rows.push_back({TextOf(*row, "fault"), AloneBeside(*row, "answer_p50"),
                          AloneBeside(*row, "answer_p99"), AloneBeside(*row, "event_p50"),
                          AloneBeside(*row, "event_p99"), "+" + TextOf(*row, "grown_mb") + " MB",
                          TextOf(*row, "grown_of_allowed"), CommandOf("soak", *row),
                          TextOf(*row, "kept")});
  }
  return table;
}

/// What grows, and what does not, from a tenth of the week to its end.
Table WeekTable(const v1::Results& results) {
  Table table{"A week of lock-step (./run soak --only week)",
              {"program", "MB after 10 %", "50 %", "100 %", "descriptors after 10 %", "100 %",
               "threads after 10 %", "100 %"},
              {}};
  for (const Row* row : Select(results, "soak", {{"name", "week"}})) {
    for (const std::string program : {"service", "client"}) {
      std::vector<std::string> cells = {program};
      for (const char* field : {"_mb_at_0.1", "_mb_at_0.5", "_mb_at_1", "_descriptors_at_0.1",
                                "_descriptors_at_1", "_threads_at_0.1", "_threads_at_1"}) {
        cells.push_back(TextOf(*row, program + field));
      }
      table.rows.push_back(cells);
    }
  }
  return table;
}

/// The most of each queue in the week.
Table QueuesTable(const v1::Results& results) {
  Table table{"The same week: the most that waited in the service", {"what", "most"}, {}};
  for (const Row* row : Select(results, "soak", {{"name", "week"}})) {
    for (const auto& [field, words] : std::vector<std::pair<const char*, const char*>>{
             {"queued_max", "entries queued"},
             {"pairs_waiting_max", "pairs that wait for their turn"},
             {"shapes_max", "shapes"},
             {"shapes_gathering_max", "shapes of which parts are missing"},
             {"trees_building_max", "trees in building"},
             {"unproven_inputs_max", "messages of unproven names"}}) {
      table.rows.push_back({words, TextOf(*row, field)});
    }
  }
  return table;
}

}  // namespace

Section LoadAndFaults(const v1::Results& results) {
  Section section{"load-and-faults", "Load and faults", {}, {}, {}};
  section.paragraphs = {
      "What the service does to the network is done here to the service: other simulators that "
      "take "
      "more than their share, networks that lose, delay, double, reorder and part, programs that "
      "are killed, stand still or lie. Each line says what is promised, what was measured, and the "
      "command that measures it again."};
  AddChart(TakeOverChart(results), &section);
  Table promised{"Times", kPromised, {}};
  AddTakeOvers(results, &promised);
  AddBounds(results, &promised);
  AddTable(std::move(promised), &section);
  AddTable(BadClientsTable(results), &section);
  AddTable(WeekTable(results), &section);
  AddTable(QueuesTable(results), &section);
  AddTable(CasesTable(results, "network", "Real programs on faulty networks, each on its own host",
                      {{"true_contacts", "true contacts"},
                       {"contacts_told", "contacts told"},
                       {"frames_lost", "frames lost", false},
                       {"frames_doubled", "frames doubled", false}}),
           &section);
  AddTable(CasesTable(results, "faults", "The same service and client library in virtual time",
                      {{"runs", "runs"},
                       {"contacts", "true contacts"},
                       {"late", "late"},
                       {"unheard", "unheard"},
                       {"relied_wrongly", "wrong clearances"},
                       {"brackets_wrong", "wrong brackets"}}),
           &section);
  AddTable(CasesTable(results, "soak", "For long, and beside bad clients",
                      {{"simulated_s", "s simulated"},
                       {"agents_admitted", "agents"},
                       {"contacts", "contacts"},
                       {"laps_alone", "laps alone"},
                       {"laps_beside", "beside"},
                       {"unended", "without an end"}}),
           &section);
  for (const char* name : {"network", "faults", "soak"}) AddWhole(results, name, &section);
  return section;
}

}  // namespace collision::report
