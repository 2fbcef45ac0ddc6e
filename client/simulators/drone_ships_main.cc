// drone-ships: a simulator of drones with a mesh that tumble about at random and bounce.

#include <cstdio>

#include "client/simulators/command_line.h"
#include "client/simulators/drone_ships.h"
#include "client/simulators/mesh_option.h"
#include "client/simulators/stop_signal.h"
#include "client/validation.h"

namespace collision::client {
namespace {

void AddFlightOptions(CLI::App* app, DroneShipOptions* options) {
  app->add_option("--drones", options->drones, "How many")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app->add_option("--first", options->first,
                  "Number of the first: each process of a swarm takes a slice")
      ->capture_default_str();
  app->add_option("--seed", options->seed, "Same for all processes of a swarm")
      ->capture_default_str();
  app->add_option("--box", options->limits.box_m,
                  "Size of the space [m]: x y z; default: 8000 m3 for each drone up to the last. "
                  "Same for all processes of a swarm")
      ->check(Finite(kCoordinateMax, false));
  app->add_option("--radius", options->limits.radius_m, "Of a drone without a mesh [m]")
      ->check(Finite(kRadiusMax, false))
      ->capture_default_str();
  app->add_option("--speed-max", options->limits.speed_max_m_s, "Of a drone [m/s]")
      ->check(Finite(kSpeedMax, false))
      ->capture_default_str();
  app->add_option("--acceleration-max", options->limits.acceleration_max_m_s2, "Of a drone [m/s2]")
      ->check(Finite(kAccelerationMax, false))
      ->capture_default_str();
  app->add_option("--angular-acceleration-max", options->turn.angular_acceleration_max_rad_s2,
                  "Of a drone [rad/s2]")
      ->check(Finite(kTurnAccelerationMax, false))
      ->capture_default_str();
  app->add_option("--turn-max", options->turn.angular_speed_max_rad_s, "Turn rate [rad/s]")
      ->check(Finite(kTurnSpeedMax, false))
      ->capture_default_str();
  app->add_option("--rate", options->rate_hz, "Steps per second")
      ->check(CLI::Range(10, 1000))
      ->capture_default_str();
  app->add_option("--state-every", options->state_every, "Steps between two states")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

int Run(const SimulatorOptions& simulator, const DroneShipOptions& options) {
  MotionLog log(simulator.motion_log);
  Pace pace(simulator);
  DroneShips flight(options, &pace, &log);
  flight.Fly();
  log.Close();
  std::printf("%zu bounces\n", flight.bounces());
  pace.ReportTraffic();
  pace.CheckRefusals();
  return kExitOk;
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
  app.add_option("--seconds", simulator.seconds, "Length of the run")
      ->required()
      ->check(Finite(kRunSecondsMax, false));
  AddMeshOptions(&app, &mesh);
  AddSimulatorOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  if (app.count("--box") == 0) options.limits.box_m = BoxFor(options.first + options.drones);
  CatchStopSignals();
  return RunProgram("drone-ships", [&] {
    options.shape = LoadAgentShape(mesh);
    return Run(simulator, options);
  });
}
