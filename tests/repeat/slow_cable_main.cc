// slow-cable: carries frames between two network devices, late, in another order, or not at all.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"
#include "tests/repeat/slow_cable.h"

int main(int argc, char** argv) {
  using namespace collision;
  std::string devices[2];
  repeat::CableFaults faults;
  CLI::App app("Carries frames between two network devices, late, in another order, or not at all.",
               "slow-cable");
  app.add_option("device-a", devices[0], "One end")->required();
  app.add_option("device-b", devices[1], "The other end")->required();
  app.add_option("--delay-min-s", faults.delay_min_s, "Of each frame")->capture_default_str();
  app.add_option("--delay-max-s", faults.delay_max_s, "Of each frame")->capture_default_str();
  app.add_option("--loss", faults.loss, "Probability that a frame is lost")->capture_default_str();
  app.add_option("--seed", faults.seed, "Of delays and losses")->capture_default_str();
  if (const auto code = client::ParseCommandLine(&app, argc, argv)) return *code;
  client::CatchStopSignals();
  return client::RunProgram("slow-cable", [&] {
    repeat::CarryFrames(devices[0], devices[1], faults);
    return 0;
  });
}
