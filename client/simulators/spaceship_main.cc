// spaceship: a simulator of one ship, steered from the terminal or by a script.

#include <cstdio>
#include <optional>

#include "client/simulators/command_line.h"
#include "client/simulators/mesh_option.h"
#include "client/simulators/spaceship.h"
#include "client/simulators/stop_signal.h"
#include "client/simulators/terminal.h"
#include "client/validation.h"

namespace collision::client {
namespace {

void AddFlightOptions(CLI::App* app, SpaceshipOptions* options, bool* autopilot) {
  app->add_flag("--autopilot", *autopilot, "A script flies; so it does where there is no terminal");
  app->add_option("--box", options->box_m, "Where the script patrols [m]: x y z, from 0")
      ->check(Finite(kCoordinateMax, false))
      ->capture_default_str();
  app->add_option("--seed", options->seed, "Of the script's patrol")->capture_default_str();
  app->add_option("--radius", options->radius_m, "Of a ship without a mesh [m]")
      ->check(Finite(kRadiusMax, false))
      ->capture_default_str();
  app->add_option("--speed-max", options->limits.speed_max_m_s, "What the engine can reach [m/s]")
      ->check(Finite(kSpeedMax, false))
      ->capture_default_str();
  app->add_option("--acceleration-max", options->limits.acceleration_max_m_s2,
                  "Of the engine [m/s2]")
      ->check(Finite(kAccelerationMax, false))
      ->capture_default_str();
  app->add_option("--angular-acceleration-max",
                  options->limits.turn.angular_acceleration_max_rad_s2, "[rad/s2]")
      ->check(Finite(kTurnAccelerationMax, false))
      ->capture_default_str();
  app->add_option("--turn-max", options->limits.turn.angular_speed_max_rad_s, "Turn rate [rad/s]")
      ->check(Finite(kTurnSpeedMax, false))
      ->capture_default_str();
  app->add_option("--rate", options->rate_hz, "Steps per second")
      ->check(CLI::Range(10, 1000))
      ->capture_default_str();
  app->add_option("--state-every", options->state_every, "Steps between two states")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

int Run(const SimulatorOptions& simulator, const SpaceshipOptions& options, bool person) {
  MotionLog log(simulator.motion_log);
  Pace pace(simulator);
  std::optional<SpaceshipScreen> screen;
  if (person) screen.emplace(simulator.world, simulator.domain);
  std::size_t bounces = 0;
  {
    Spaceship flight(options, &pace, &log, person ? &*screen : nullptr);
    flight.Fly();
    bounces = flight.bounces();
  }
  log.Close();
  screen.reset();  // from here on the terminal is as it was
  std::printf("%zu bounces\n", bounces);
  pace.ReportTraffic();
  pace.CheckRefusals();
  return kExitOk;
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  SpaceshipOptions options;
  MeshOptions mesh;
  bool autopilot = false;
  CLI::App app(
      "Flies a spaceship in a world of the collision service. It is steered from the terminal "
      "(h shows the keys, q ends), or by a script.",
      "spaceship");
  AddFlightOptions(&app, &options, &autopilot);
  app.add_option("--seconds", simulator.seconds, "Longest run")
      ->required()
      ->check(Finite(kRunSecondsMax, false));
  AddMeshOptions(&app, &mesh);
  AddSimulatorOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  const bool person = !autopilot && HasTerminal();
  // A person flies at the pace of life.
  if (person && app.count("--speed") == 0) simulator.speed = 1;
  CatchStopSignals();
  return RunProgram("spaceship", [&] {
    options.shape = LoadAgentShape(mesh, person);
    return Run(simulator, options, person);
  });
}
