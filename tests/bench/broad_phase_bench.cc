// ./run bench broad-phase: our broad phase beside the libraries, the baselines and itself.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/json.h"
#include "tests/bench/parts.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the broad phase beside its peers, one thread, inputs seeded.",
               "broad-phase-bench");
  Settings settings;
  std::string json;
  app.add_flag("--quick", settings.quick, "fewer agents and repetitions: a few minutes");
  app.add_option("--json", json, "write every measurement and the figures to this file");
  app.add_option("--only", settings.only,
                 "only cells whose name PART/SCENE/AGENTS/CONTESTANT contains this");
  app.add_option("--swarm-report", settings.swarm_report,
                 "what ./run demo swarm --json wrote: for the swarm's figure")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, count, arguments);
  Report report;
  ScratchPart(settings, &report);
  IncrementalPart(settings, &report);
  TurkPart(settings, &report);
  ScenesPart(settings, &report);
  SwarmPart(settings, &report);
  std::fputs(report.Table().c_str(), stdout);
  return WriteJson(json, report.Json());
}
