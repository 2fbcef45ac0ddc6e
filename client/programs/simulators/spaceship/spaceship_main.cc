// spaceship: a simulator of one ship, steered from the terminal or by a script.

#include <cstdio>
#include <optional>

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/mesh_option.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/shared/terminal.h"
#include "client/programs/simulators/motion/motion_options.h"
#include "client/programs/simulators/motion/simulator_run.h"
#include "client/programs/simulators/spaceship/spaceship.h"

namespace collision::client {
namespace {

void AddFlightOptions(CLI::App* app, SpaceshipOptions* options, bool* autopilot) {
  app->add_flag("--autopilot", *autopilot, "A script flies, as it does without a terminal");
  app->add_option("--box", options->box_m, "Space that the script patrols [m]: x y z, from 0")
      ->delimiter(',')
      ->check(Finite(kCoordinateMax, false))
      ->capture_default_str();
  app->add_option("--seed", options->seed, "Seed of the script's patrol")->capture_default_str();
  app->add_option("--radius", options->radius_m, "Radius of a ship without a shape [m]")
      ->check(Finite(kRadiusMax, false))
      ->capture_default_str();
  AddSpeedOptions(app, &options->limits.speed_max_m_s, &options->limits.acceleration_max_m_s2);
  AddTurnOptions(app, &options->limits.turn);
  AddStepOptions(app, &options->rate_hz, &options->state_every);
}

int Run(const SimulatorOptions& simulator, const SpaceshipOptions& options, bool person) {
  return RunSimulator(simulator, [&](Pace* pace, MotionLog* log) {
    std::size_t bounces = 0;
    {
      std::optional<SpaceshipScreen> screen;  // restores the terminal when it goes
      if (person) screen.emplace(simulator.world, simulator.domain);
      Spaceship flight(options, pace, log, person ? &*screen : nullptr);
      flight.Fly();
      bounces = flight.bounces();
    }
    std::printf("%zu bounces\n", bounces);
  });
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
  AddMeshOptions(&app, &mesh);
  AddRunOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  const bool person = !autopilot && HasTerminal();
  // A person flies in real time.
  if (person && app.count("--speed") == 0) simulator.speed = 1;
  CatchStopSignals();
  return RunProgram("spaceship", [&] {
    options.shape = LoadAgentShape(mesh, person);
    return Run(simulator, options, person);
  });
}
