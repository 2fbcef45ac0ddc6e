// ./run bench precision: error against run time, ours beside the libraries.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/json.h"
#include "tests/bench/narrow_mesh.h"
#include "tests/bench/precision_cell.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures error against run time, one thread, inputs seeded.", "precision-bench");
  PrecisionSettings settings;
  settings.data_dir = COLLISION_DATA_DIR;
  std::string json;
  app.add_flag("--quick", settings.quick, "fewer meshes and poses: less than 20 seconds");
  app.add_option("--json", json, "write every measurement and the figures to this file");
  app.add_option("--only", settings.only,
                 "only rows whose name PART/MOTION/MESH/METHOD/SETTING contains this");
  app.add_option("--data", settings.data_dir, "the folder with meshes/*.obj");
  CLI11_PARSE(app, count, arguments);
  if (ContestMeshes(settings.data_dir, true).empty()) {
    std::fprintf(stderr, "bench: no meshes in '%s/meshes': homer, spot and rocker-arm are wanted\n",
                 settings.data_dir.c_str());
    return 66;
  }
  PrecisionReport report;
  MeshesPart(settings, &report);
  ConvexesPart(settings, &report);
  ContactTimesPart(settings, &report);
  SetFigures(&report);
  std::fputs(report.Table().c_str(), stdout);
  return WriteJson(json, report.Json());
}
