// ./run report: what the service may spend on a pair in a turn, against how exact its answers are.
//
// The scene runs with one budget after the other, of a pair's turn and of a step of all pairs:
// widths, undecided events, work. The program fails if a run fails, or if its checker is not
// satisfied.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/harness/json.h"
#include "tests/bench/scenes/scene_run.h"

namespace collision::bench {
namespace {

constexpr char kScene[] = "spaceships-100";

/// Either what a pair may cost in its turn, or what all pairs together may cost in a step.
struct Budget {
  const char* kind;
  const char* field;                ///< Of the service's configuration.
  const char* limited_by;           ///< What keeps brackets from being narrower.
  std::vector<double> quick, full;  ///< [µs]
};

std::vector<Budget> Budgets() {
  return {{"a pair's turn",
           "time_budget_us",
           "the turn's end; at last how often states come (60 a second)",
           {0, 50, 200, 2000},
           {0, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000}},
          {"a step of all pairs",
           "step_budget_us",
           "each pair's share of the step; at last how often states come (60 a second)",
           {100, 1000, 10000},
           {20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 50000}}};
}

double SecondsOf(bool quick) { return quick ? 8 : 20; }

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

std::string RowOf(const Budget& of, double budget, const v1::RunReport& report) {
  const double closed = static_cast<double>(report.events_ended() + report.events_undecided() +
                                            report.events_dismissed());
  const auto undecided = static_cast<double>(report.events_undecided());
  const auto width = [](const v1::Quantiles& q) { return Counted(q, q.p50()); };
  return Object(
      {Text("part", "budget"), Text("scene", kScene), Text("kind", of.kind),
       Number("budget_us", budget), Number("agents", report.agents()),
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
       Number("evaluations_cut_short",
              static_cast<double>(CounterOf(report, "evaluations_cut_short"))),
       Number("cpu_seconds_per_simulated_second", report.cpu_seconds_per_simulated_second()),
       Text("limited_by", of.limited_by)});
}

struct Sums {
  std::vector<std::string> rows;
  double unannounced = 0, failed = 0;
  std::optional<double> first, last;  ///< Median widths of the begin, of pairs' turns.
};

void RunOne(const SceneOptions& options, const Budget& of, double budget, Sums* sums) {
  char config[60];
  std::snprintf(config, sizeof config, "%s: %.0f", of.field, budget);
  const auto report = RunScene(
      options.folders, {.scene = kScene, .seconds = SecondsOf(options.quick), .config = config});
  if (!report) {
    ++sums->failed;
    return;
  }
  sums->unannounced += static_cast<double>(report->contacts_unannounced());
  const auto width = Counted(report->begin_width_s(), report->begin_width_s().p50());
  if (width && !sums->first) sums->first = width;
  if (width && std::string(of.field) == "time_budget_us") sums->last = width;
  sums->rows.push_back(RowOf(of, budget, *report));
  std::fprintf(stderr, "bench: %s, %s: begin bracket %s\n", kScene, config,
               width ? SecondsText(*width).c_str() : "-");
}

int Run(const SceneOptions& options) {
  Figures figures({"unannounced_misses", "begin_width_least_over_most_budget", "runs_failed"});
  Sums sums;
  for (const Budget& of : Budgets()) {
    if (!options.Wants(of.field)) continue;
    for (const double budget : options.quick ? of.quick : of.full) {
      RunOne(options, of, budget, &sums);
    }
  }
  figures.Set("unannounced_misses", sums.unannounced);
  figures.Set("runs_failed", sums.failed);
  if (sums.first && sums.last.value_or(0) > 0) {
    figures.Set("begin_width_least_over_most_budget", *sums.first / *sums.last);
  }
  std::fputs(figures.Table().c_str(), stdout);
  if (const int status = WriteJson(options.json, figures.Json(sums.rows)); status != 0)
    return status;
  return sums.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace collision::bench

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Runs a scene with one budget after the other: work against width.", "budget-bench");
  SceneOptions options;
  options.AddTo(&app, "fewer budgets, fewer seconds", "only budgets whose field contains this");
  CLI11_PARSE(app, count, arguments);
  return Run(options);
}
