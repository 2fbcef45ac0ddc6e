// ./run report: what the service may spend on a pair in a turn, against how exact its answers are.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "tests/bench/json.h"
#include "tests/bench/scene_run.h"

namespace collision::bench {
namespace {

constexpr char kScene[] = "spaceships-100";

struct Plan {
  std::vector<double> budgets;  ///< [µs]
  double seconds;               ///< Simulated.
};

Plan PlanOf(bool quick) {
  if (quick) return {{0, 50, 200, 500, 2000}, 8};
  return {{0, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000}, 20};
}

/// Widths of nothing are not measured.
std::optional<double> Counted(const v1::Quantiles& quantiles, double value) {
  return quantiles.count() == 0 ? std::nullopt : std::optional(value);
}

std::uint64_t CounterOf(const v1::RunReport& report, const std::string& name) {
  for (const v1::Counter& counter : report.counters()) {
    if (counter.name() == name) return counter.value();
  }
  return 0;
}

std::string RowOf(double budget, const v1::RunReport& report) {
  const double closed = static_cast<double>(report.events_ended() + report.events_undecided() +
                                            report.events_dismissed());
  const auto undecided = static_cast<double>(report.events_undecided());
  const auto width = [](const v1::Quantiles& q) { return Counted(q, q.p50()); };
  return Object(
      {Text("part", "budget"), Text("scene", kScene), Number("time_budget_us", budget),
       Number("agents", report.agents()),
       Number("contacts_true", static_cast<double>(report.contacts_true())),
       Number("contacts_unannounced", static_cast<double>(report.contacts_unannounced())),
       Number("undecided", undecided), Number("closed", closed),
       Number("undecided_share", closed > 0 ? std::optional(undecided / closed) : std::nullopt),
       Number("begin_width_p50_s", width(report.begin_width_s())),
       Number("begin_width_p99_s", Counted(report.begin_width_s(), report.begin_width_s().p99())),
       Number("end_width_p50_s", width(report.end_width_s())),
       Number("separation_width_p50_m", width(report.separation_width_m())),
       Number("normal_error_p50_rad", width(report.normal_error_rad())),
       Number("work_units", static_cast<double>(CounterOf(report, "work_units"))),
       Number("turns_cut_short", static_cast<double>(CounterOf(report, "turns_cut_short"))),
       Number("cpu_seconds_per_simulated_second", report.cpu_seconds_per_simulated_second()),
       Text(
           "limited_by",
           "below 1 ms a pair's turn ends before its brackets are narrow; beyond, how often states "
           "come (60 a second)")});
}

int Run(const SceneFolders& folders, bool quick, const std::string& json) {
  const Plan plan = PlanOf(quick);
  Figures figures({"unannounced_misses", "begin_width_least_over_most_budget", "runs_failed"});
  std::vector<std::string> rows;
  double unannounced = 0, failed = 0;
  std::optional<double> first, last;
  for (const double budget : plan.budgets) {
    char config[60];
    std::snprintf(config, sizeof config, "time_budget_us: %.0f", budget);
    const auto report =
        RunScene(folders, {.scene = kScene, .seconds = plan.seconds, .config = config});
    if (!report) {
      ++failed;
      continue;
    }
    unannounced += static_cast<double>(report->contacts_unannounced());
    const auto width = Counted(report->begin_width_s(), report->begin_width_s().p50());
    if (width && !first) first = width;
    if (width) last = width;
    rows.push_back(RowOf(budget, *report));
    std::fprintf(stderr, "bench: %s, %s: begin bracket %s\n", kScene, config,
                 width ? SecondsText(*width).c_str() : "-");
  }
  figures.Set("unannounced_misses", unannounced);
  figures.Set("runs_failed", failed);
  if (first && *last > 0) figures.Set("begin_width_least_over_most_budget", *first / *last);
  std::fputs(figures.Table().c_str(), stdout);
  if (!json.empty()) {
    std::ofstream file(json);
    file << figures.Json(rows);
    file.close();
    if (!file) {
      std::fprintf(stderr, "bench: cannot write %s\n", json.c_str());
      return 74;
    }
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace collision::bench

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Runs a scene with one budget after the other: work against width.", "budget-bench");
  SceneFolders folders;
  bool quick = false;
  std::string json;
  app.add_flag("--quick", quick, "fewer budgets, fewer seconds");
  app.add_option("--json", json, "write every measurement and the figures to this file");
  app.add_option("--bin", folders.programs, "folder of the programs")->required();
  app.add_option("--scenes", folders.scenes, "folder of the scenes")->required();
  app.add_option("--data", folders.data, "folder of the data sets")->required();
  CLI11_PARSE(app, count, arguments);
  return Run(folders, quick, json);
}
