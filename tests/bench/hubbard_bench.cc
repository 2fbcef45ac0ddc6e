// ./run bench hubbard: sphere trees beside BSP trees, and both phases beside Turk with BSP trees.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/hubbard_parts.h"
#include "tests/bench/json.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("A spaceship among drones: ours beside what Hubbard's paper compared with.",
               "hubbard-bench");
  HubbardSettings settings;
  settings.scenes_dir = COLLISION_SCENES_DIR;
  std::string json;
  app.add_flag("--quick", settings.quick, "fewer drones and frames: less than 20 seconds");
  app.add_option("--json", json, "write every measurement and the figures to this file");
  app.add_option("--only", settings.only, "only rows whose name PART/SCENE/METHOD contains this");
  app.add_option("--scenes", settings.scenes_dir,
                 "the folder with spaceship.obj and drone-ship.obj");
  CLI11_PARSE(app, count, arguments);
  HubbardReport report;
  if (!MeasureHubbard(settings, &report)) {
    std::fprintf(stderr, "bench: no spaceship.obj and drone-ship.obj in '%s'\n",
                 settings.scenes_dir.c_str());
    return 66;
  }
  std::fputs(report.Table().c_str(), stdout);
  return WriteJson(json, report.Json());
}
