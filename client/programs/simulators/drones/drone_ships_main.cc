// drone-ships: a simulator of drones with a shape that tumble at random and bounce.

#include <cstdio>

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/mesh_option.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/simulators/drones/drone_ships.h"
#include "client/programs/simulators/motion/motion_options.h"
#include "client/programs/simulators/motion/simulator_run.h"

namespace collision::client {
namespace {

void AddFlightOptions(CLI::App* app, DroneShipOptions* options) {
  app->add_option("--drones", options->drones, "Number of drones")
      ->check(WholeBetween(1, 100000))
      ->capture_default_str();
  app->add_option("--first", options->first,
                  "Number of the first: each process of a swarm takes a slice")
      ->capture_default_str();
  app->add_option("--seed", options->seed, "Seed, the same for all processes of a swarm")
      ->capture_default_str();
  app->add_option("--box", options->limits.box_m,
                  "Size of the space [m]: x y z, the same for all processes of a swarm; default: "
                  "8000 m3 for each drone up to the last")
      ->delimiter(',')
      ->check(Finite(kCoordinateMax, false));
  app->add_option("--radius", options->limits.radius_m, "Radius of a drone without a shape [m]")
      ->check(Finite(kRadiusMax, false))
      ->capture_default_str();
  AddSpeedOptions(app, &options->limits.speed_max_m_s, &options->limits.acceleration_max_m_s2);
  AddTurnOptions(app, &options->turn);
  AddStepOptions(app, &options->rate_hz, &options->state_every);
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  DroneShipOptions options;
  options.limits.radius_m = 1.2;
  options.limits.speed_max_m_s = 8;
  options.limits.acceleration_max_m_s2 = 4;
  MeshOptions mesh;
  CLI::App app(
      "Flies drone ships under random forces and torques in a world of the collision service.",
      "drone-ships");
  AddFlightOptions(&app, &options);
  AddMeshOptions(&app, &mesh);
  AddRunOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  if (app.count("--box") == 0) options.limits.box_m = BoxFor(options.first + options.drones);
  CatchStopSignals();
  return RunProgram("drone-ships", [&] {
    options.shape = LoadAgentShape(mesh);
    return RunSimulator(simulator, [&](Pace* pace, MotionLog* log) {
      DroneShips flight(options, pace, log);
      flight.Fly();
      std::printf("%zu bounces\n", flight.bounces());
    });
  });
}
