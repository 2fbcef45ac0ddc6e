// ./run bench narrow-phase: our narrow phase beside the libraries and itself.
#include <CLI/CLI.hpp>

#include "tests/bench/narrow_phase/parts.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the narrow phase beside its peers, one thread, inputs seeded.",
               "narrow-phase-bench");
  NarrowSettings settings;
  settings.data_dir = COLLISION_DATA_DIR;
  settings.AddTo(&app, "fewer meshes and poses: a few minutes",
                 "only rows whose name PART/MESH/GAP/CONTESTANT contains this");
  app.add_option("--data", settings.data_dir, "the folder with meshes/*.obj");
  CLI11_PARSE(app, count, arguments);
  if (!HasContestMeshes(settings.data_dir)) return 66;
  NarrowReport report;
  ContestPart(settings, &report);
  ConvexPart(settings, &report);
  TreesPart(settings, &report);
  BuildPart(settings, &report);
  RefinementPart(settings, &report);
  BudgetPart(settings, &report);
  ContactCasesPart(settings, &report);
  ContactPart(settings, &report);
  return Finish(report, settings.json);
}
