#include "client/programs/simulators/motion/simulator_run.h"

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"

namespace collision::client {

void AddRunOptions(CLI::App* app, SimulatorOptions* options) {
  app->add_option("--seconds", options->seconds, "Length of the run")
      ->required()
      ->check(Finite(kRunSecondsMax, false));
  AddSimulatorOptions(app, options);
}

int RunSimulator(const SimulatorOptions& options,
                 const std::function<void(Pace* pace, MotionLog* log)>& move) {
  MotionLog log(options.motion_log);
  Pace pace(options);
  move(&pace, &log);
  // Who heard of events is gone; some may still come.
  pace.world().OnEvent(nullptr);
  log.Close();
  pace.ReportTraffic();
  pace.CheckRefusals();
  return kExitOk;
}

}  // namespace collision::client
