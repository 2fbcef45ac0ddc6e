// ./run bench narrow-phase: our narrow phase beside the libraries and itself.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/json.h"
#include "tests/bench/narrow_parts.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the narrow phase beside its peers, one thread, inputs seeded.",
               "narrow-phase-bench");
  NarrowSettings settings;
  settings.data_dir = COLLISION_DATA_DIR;
  std::string json;
  app.add_flag("--quick", settings.quick, "fewer meshes and poses: a few minutes");
  app.add_option("--json", json, "write every measurement and the figures to this file");
  app.add_option("--only", settings.only,
                 "only rows whose name PART/MESH/GAP/CONTESTANT contains this");
  app.add_option("--data", settings.data_dir, "the folder with meshes/*.obj");
  CLI11_PARSE(app, count, arguments);
  if (ContestMeshes(settings.data_dir, settings.quick).empty()) {
    std::fprintf(stderr, "bench: no meshes in '%s/meshes': homer, spot and rocker-arm are wanted\n",
                 settings.data_dir.c_str());
    return 66;
  }
  NarrowReport report;
  ContestPart(settings, &report);
  ConvexPart(settings, &report);
  TreesPart(settings, &report);
  BuildPart(settings, &report);
  RefinementPart(settings, &report);
  BudgetPart(settings, &report);
  ContactCasesPart(settings, &report);
  ContactPart(settings, &report);
  std::fputs(report.Table().c_str(), stdout);
  return WriteJson(json, report.Json());
}
