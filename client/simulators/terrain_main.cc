// terrain: a simulator of ground that never moves, as large a mesh as one likes.

#include <cstdio>

#include "client/simulators/command_line.h"
#include "client/simulators/stop_signal.h"
#include "client/simulators/terrain.h"
#include "client/validation.h"

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  TerrainOptions terrain;
  CLI::App app("Puts hills into a world of the collision service: one agent that never moves.",
               "terrain");
  app.add_option("--triangles", terrain.triangles, "Of its mesh, at most")
      ->check(CLI::Range(kTerrainTrianglesMin, kShapeTrianglesMax))
      ->capture_default_str();
  app.add_option("--size", terrain.size_m, "Of its square, from the origin along +x and +y [m]")
      ->check(Finite(kTerrainSizeMax, false))
      ->capture_default_str();
  app.add_option("--relief", terrain.relief_m,
                 "Height of the highest summit that may be above the lowest valley [m]")
      ->check(Finite(kTerrainSizeMax, false))
      ->capture_default_str();
  app.add_option("--base", terrain.base_m, "Where the lowest valley may be: z [m]")
      ->check(CLI::Range(-kTerrainSizeMax, kTerrainSizeMax))
      ->capture_default_str();
  app.add_option("--seed", terrain.seed, "Which hills")->capture_default_str();
  app.add_option("--await-tree", terrain.await_tree_s,
                 "Wait so long [s] for the service to have its sphere tree, then begin; 0 to 25")
      ->check(Finite(kAwaitTreeMax, true))
      ->capture_default_str();
  app.add_flag("--coarse", terrain.coarse_is_enough,
               "Do not wait longer than for the coarse tree, which is there first");
  app.add_option("--seconds", simulator.seconds, "Length of the run")
      ->required()
      ->check(Finite(kRunSecondsMax, false));
  AddSimulatorOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  CatchStopSignals();
  return RunProgram("terrain", [&] {
    MotionLog log(simulator.motion_log);
    Pace pace(simulator);
    ServeTerrain(terrain, simulator, &pace, &log);
    log.Close();
    pace.ReportTraffic();
    pace.CheckRefusals();
    return static_cast<int>(kExitOk);
  });
}
