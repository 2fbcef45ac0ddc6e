// ./run bench broad-phase: our broad phase beside the libraries, the baselines and itself.
#include <CLI/CLI.hpp>

#include "tests/bench/broad_phase/parts.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the broad phase beside its peers, one thread, inputs seeded.",
               "broad-phase-bench");
  Settings settings;
  settings.AddTo(&app, "fewer agents and repetitions: a few minutes",
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
  return Finish(report, settings.json);
}
