// terrain: a simulator of ground that never moves, with a mesh of any size.

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/simulators/motion/simulator_run.h"
#include "client/programs/simulators/terrain/terrain.h"

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  TerrainOptions terrain;
  CLI::App app("Puts hills into a world of the collision service: one agent that never moves.",
               "terrain");
  app.add_option("--triangles", terrain.triangles, "Greatest number of triangles")
      ->check(WholeBetween(kTerrainTrianglesMin, kShapeTrianglesMax))
      ->capture_default_str();
  app.add_option("--size", terrain.size_m, "Side of its square, from the origin along +x, +y [m]")
      ->check(Finite(kTerrainSizeMax, false))
      ->capture_default_str();
  app.add_option("--relief", terrain.relief_m,
                 "Greatest height of a summit above the lowest valley [m]")
      ->check(Finite(kTerrainSizeMax, false))
      ->capture_default_str();
  app.add_option("--base", terrain.base_m, "z of the lowest possible valley [m]")
      ->check(Between(-kTerrainSizeMax, kTerrainSizeMax))
      ->capture_default_str();
  app.add_option("--seed", terrain.seed, "Seed of the hills")->capture_default_str();
  AddRunOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  CatchStopSignals();
  return RunProgram("terrain", [&] {
    return RunSimulator(simulator,
                        [&](Pace* pace, MotionLog* log) { ServeTerrain(terrain, pace, log); });
  });
}
