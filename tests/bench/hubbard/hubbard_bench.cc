// ./run bench hubbard: sphere trees beside BSP trees, and both phases beside Turk with BSP trees.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/hubbard/parts.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("A spaceship among drones: ours beside what Hubbard's paper compared with.",
               "hubbard-bench");
  HubbardSettings settings;
  settings.scenes_dir = COLLISION_SCENES_DIR;
  settings.AddTo(&app, "fewer drones and frames: less than 20 seconds",
                 "only rows whose name PART/SCENE/METHOD contains this");
  app.add_option("--scenes", settings.scenes_dir,
                 "the folder with spaceship.obj and drone-ship.obj");
  CLI11_PARSE(app, count, arguments);
  HubbardReport report;
  if (!MeasureHubbard(settings, &report)) {
    std::fprintf(stderr, "bench: no spaceship.obj and drone-ship.obj in '%s'\n",
                 settings.scenes_dir.c_str());
    return 66;
  }
  return Finish(report, settings.json);
}
