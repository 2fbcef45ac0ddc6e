// drone-swarm: a simulator of drones that fly about at random and bounce off each other.

#include <cstdio>

#include "client/simulators/command_line.h"
#include "client/simulators/stop_signal.h"
#include "client/simulators/swarm.h"
#include "client/validation.h"

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  SwarmOptions swarm;
  CLI::App app("Flies drones under random forces in a world of the collision service.",
               "drone-swarm");
  app.add_option("--drones", swarm.drones, "How many")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--first", swarm.first,
                 "Number of the first: each process of a swarm takes a slice")
      ->capture_default_str();
  app.add_option("--seed", swarm.seed, "Same for all processes of a swarm")->capture_default_str();
  app.add_option("--box", swarm.limits.box_m, "Size of the space [m]: x y z")
      ->check(Finite(kCoordinateMax, false))
      ->capture_default_str();
  app.add_option("--radius", swarm.limits.radius_m, "Of a drone [m]")
      ->check(Finite(kRadiusMax, false))
      ->capture_default_str();
  app.add_option("--speed-max", swarm.limits.speed_max_m_s, "Of a drone [m/s]")
      ->check(Finite(kSpeedMax, false))
      ->capture_default_str();
  app.add_option("--acceleration-max", swarm.limits.acceleration_max_m_s2, "Of a drone [m/s2]")
      ->check(Finite(kAccelerationMax, false))
      ->capture_default_str();
  app.add_option("--rate", swarm.rate_hz, "Steps per second")
      ->check(CLI::Range(10, 1000))
      ->capture_default_str();
  app.add_option("--state-every", swarm.state_every, "Steps between two states")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--seconds", simulator.seconds, "Length of the run")
      ->required()
      ->check(Finite(kRunSecondsMax, false));
  AddSimulatorOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  CatchStopSignals();
  return RunProgram("drone-swarm", [&] {
    MotionLog log(simulator.motion_log);
    Pace pace(simulator);
    Swarm flight(swarm, &pace, &log);
    flight.Fly();
    log.Close();
    std::printf("%zu bounces\n", flight.bounces());
    pace.CheckRefusals();
    return static_cast<int>(kExitOk);
  });
}
