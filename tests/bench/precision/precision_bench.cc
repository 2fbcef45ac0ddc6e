// ./run bench precision: error against run time, ours beside the libraries.
#include <CLI/CLI.hpp>

#include "tests/bench/pairs/bench_mesh.h"
#include "tests/bench/precision/cell.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures error against run time, one thread, inputs seeded.", "precision-bench");
  PrecisionSettings settings;
  settings.data_dir = COLLISION_DATA_DIR;
  settings.AddTo(&app, "fewer meshes and poses: less than 20 seconds",
                 "only rows whose name PART/MOTION/MESH/METHOD/SETTING contains this");
  app.add_option("--data", settings.data_dir, "the folder with meshes/*.obj");
  CLI11_PARSE(app, count, arguments);
  if (!HasContestMeshes(settings.data_dir)) return 66;
  PrecisionReport report;
  MeshesPart(settings, &report);
  ConvexesPart(settings, &report);
  ContactTimesPart(settings, &report);
  SetFigures(&report);
  return Finish(report, settings.json);
}
