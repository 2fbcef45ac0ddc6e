// drone-swarm: a simulator of drones that fly at random and bounce off each other.

#include <cstdio>

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/simulators/drones/swarm.h"
#include "client/programs/simulators/motion/motion_options.h"
#include "client/programs/simulators/motion/simulator_run.h"

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  SwarmOptions swarm;
  CLI::App app("Flies drones under random forces in a world of the collision service.",
               "drone-swarm");
  app.add_option("--drones", swarm.drones, "Number of drones")
      ->check(WholeBetween(1, 100000))
      ->capture_default_str();
  app.add_option("--first", swarm.first,
                 "Number of the first: each process of a swarm takes a slice")
      ->capture_default_str();
  app.add_option("--seed", swarm.seed, "Seed, the same for all processes of a swarm")
      ->capture_default_str();
  app.add_option("--box", swarm.limits.box_m, "Size of the space [m]: x y z")
      ->delimiter(',')
      ->check(Finite(kCoordinateMax, false))
      ->capture_default_str();
  app.add_option("--radius", swarm.limits.radius_m, "Radius of a drone [m]")
      ->check(Finite(kRadiusMax, false))
      ->capture_default_str();
  AddSpeedOptions(&app, &swarm.limits.speed_max_m_s, &swarm.limits.acceleration_max_m_s2);
  AddStepOptions(&app, &swarm.rate_hz, &swarm.state_every);
  app.add_flag("--declare-speed", swarm.declares_speed,
               "Declare the greatest speed: slightly fewer states, more work for the service");
  app.add_option("--force-every", swarm.force_every,
                 "Steps for which a drone holds a force; at most 0.1 s in all")
      ->check(WholeBetween(1, 100))
      ->capture_default_str();
  app.add_option("--places", swarm.limits.places,
                 "Number of places between which the drones fly; many spread the drones out")
      ->check(WholeBetween(1, 1000000))
      ->capture_default_str();
  AddRunOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  if (static_cast<double>(swarm.force_every) > kForceHeldMax * swarm.rate_hz * (1 + 1e-9)) {
    std::fprintf(stderr,
                 "drone-swarm: --force-every: %zu steps of 1/%g s, allowed: 0.1 s at most\n",
                 swarm.force_every, swarm.rate_hz);
    return kExitUsage;
  }
  CatchStopSignals();
  return RunProgram("drone-swarm", [&] {
    return RunSimulator(simulator, [&](Pace* pace, MotionLog* log) {
      Swarm flight(swarm, pace, log);
      flight.Fly();
      std::printf("%zu bounces\n", flight.bounces());
    });
  });
}
