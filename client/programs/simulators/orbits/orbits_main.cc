// orbits: a simulator of satellites in low orbit.

#include <map>

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/simulators/motion/simulator_run.h"
#include "client/programs/simulators/orbits/orbits.h"

namespace collision::client {
namespace {

constexpr double kAltitudeMax = 2e6;  // of a low orbit [m]

const std::map<std::string, bool> kTold = {{"always", true}, {"never", false}};

void AddOrbitOptions(CLI::App* app, OrbitsOptions* options) {
  ConstellationOptions& constellation = options->constellation;
  app->add_option("--satellites", options->satellites, "Number of satellites")
      ->check(WholeBetween(1, 100000))
      ->capture_default_str();
  app->add_option("--first", options->first,
                  "Number of the first: each process of a constellation takes a slice")
      ->capture_default_str();
  app->add_option("--seed", constellation.seed, "Seed, the same for all processes")
      ->capture_default_str();
  app->add_option("--crossings", constellation.crossings,
                  "Times at which a part of the satellites cross each other's paths")
      ->check(WholeBetween(1, 100000))
      ->capture_default_str();
  app->add_option("--spread", constellation.spread_m, "Radius of a crossing [m]")
      ->check(Finite(1e6, false))
      ->capture_default_str();
  app->add_option("--altitude", constellation.altitude_m, "Of the crossings [m]")
      ->check(Finite(kAltitudeMax, false))
      ->capture_default_str();
  app->add_option("--step", constellation.step_s, "Of the integrator, at most [s]")
      ->check(Finite(60, false))
      ->capture_default_str();
  app->add_option("--radius", options->radius_m, "Of the keep-out ball of a satellite [m]")
      ->check(Finite(kRadiusMax, true))
      ->capture_default_str();
  app->add_option("--rate", options->rate_hz, "States a second")
      ->check(Finite(1000, false))
      ->capture_default_str();
  app->add_option("--known-acceleration", options->tells_acceleration,
                  "Whether states tell the acceleration of gravity: always or never")
      ->transform(ValueOf(kTold))
      ->default_str("always");
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) {
  using namespace collision::client;
  SimulatorOptions simulator;
  OrbitsOptions options;
  CLI::App app("Moves satellites in low orbit in a world of the collision service.", "orbits");
  AddOrbitOptions(&app, &options);
  AddRunOptions(&app, &simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  CatchStopSignals();
  options.constellation.seconds = simulator.seconds;
  return RunProgram("orbits", [&] {
    return RunSimulator(simulator, [&](Pace* pace, MotionLog* log) {
      Orbits orbits(options, pace, log);
      orbits.PrintBounds();
      orbits.Fly();
    });
  });
}
