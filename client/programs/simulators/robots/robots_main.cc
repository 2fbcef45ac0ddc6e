// robots: a simulator of robots with several links, each of them an assembly.

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/simulators/motion/motion_options.h"
#include "client/programs/simulators/motion/simulator_run.h"
#include "client/programs/simulators/robots/robots.h"

namespace collision::client {
namespace {

void AddRobotOptions(CLI::App* app, RobotOptions* options) {
  app->add_option("--robots", options->robots, "Number of robots")
      ->check(WholeBetween(1, 10000))
      ->capture_default_str();
  app->add_option("--links", options->limits.links, "Links of a robot")
      ->check(WholeBetween(1, 100))
      ->capture_default_str();
  app->add_option("--first", options->first,
                  "Number of the first: each process of a crowd takes a slice")
      ->capture_default_str();
  app->add_option("--seed", options->seed, "Seed, the same for all processes of a crowd")
      ->capture_default_str();
  app->add_option("--box", options->limits.base.box_m,
                  "Size of the space [m]: x y z, the same for all processes of a crowd")
      ->delimiter(',')
      ->check(Finite(kCoordinateMax, false))
      ->capture_default_str();
  app->add_option("--class", options->class_name,
                  "Class of all links, one of the service's configuration");
  AddSpeedOptions(app, &options->limits.base.speed_max_m_s,
                  &options->limits.base.acceleration_max_m_s2);
  AddTurnOptions(app, &options->limits.turn);
  app->add_option("--rate", options->rate_hz, "Steps per second")
      ->check(Between(20.0, 1000.0))
      ->capture_default_str();
  app->add_option("--state-every", options->state_every, "Steps between two states of a link")
      ->check(WholeBetween(1, 1000))
      ->capture_default_str();
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  RobotOptions options;
  options.limits.base.box_m = {70, 70, 35};
  options.limits.base.speed_max_m_s = 8;
  options.limits.base.acceleration_max_m_s2 = 4;
  CLI::App app("Moves robots of several links in a world of the collision service.", "robots");
  AddRobotOptions(&app, &options);
  AddRunOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  CatchStopSignals();
  return RunProgram("robots", [&] {
    return RunSimulator(simulator,
                        [&](Pace* pace, MotionLog* log) { Robots(options, pace, log).Move(); });
  });
}
