#include "client/programs/tools/recordings/convert.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include "client/library/network/dds_transport.h"
#include "client/library/notices/notices.h"
#include "client/programs/recordings/world_recorder.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/tools/collisionctl/agents_watcher.h"
#include "client/programs/tools/recordings/replay_options.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

constexpr std::chrono::milliseconds kWaitMax{100};  ///< Longest time to notice the end.
constexpr double kRecordSecondsMax = 1e7;

constexpr const char* kMcapFooter = R"(
An MCAP file has every message on a channel with the name of its topic, as protobuf with its
schema, and what the gateway's page needs to show it (drop the file onto the page). Its times are
the world's; where these begin anew, FILE.2.mcap begins. Foxglove, Lichtblick and PlotJuggler read
it.)";

constexpr const char* kConvertFooter = R"(
Examples:
  collisiond --record run.rec                          record a service
  collisionctl convert run.rec run.mcap
  collisionctl convert /var/lib/collisiond/lab night.mcap --from 2026-11-29T03:00
)";

constexpr const char* kRecordFooter = R"(
Examples:
  collisionctl record now.mcap --seconds 60
  collisionctl --world lab record lab.mcap             until Ctrl-C
)";

std::chrono::nanoseconds Nanoseconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

void PrintFiles(const WorldRecorder& recorder) {
  for (const auto& [path, messages] : recorder.files()) {
    std::cout << path << ": " << messages << " messages\n";
  }
}

}  // namespace

CLI::App* AddConvertCommand(CLI::App* app, ConvertOptions* options) {
  CLI::App* command =
      app->add_subcommand("convert", "A recording as an MCAP file, for Foxglove and others");
  AddReplayOptions(command, &options->input, &options->from, &options->until);
  command->add_option("OUTPUT", options->output, "MCAP file; a former one is replaced")->required();
  AddRateOption(command, "How often the channels for the page and Foxglove are written",
                &options->rate_hz);
  command->footer(std::string(kConvertFooter) + kMcapFooter);
  return command;
}

CLI::App* AddRecordCommand(CLI::App* app, ConvertOptions* options) {
  CLI::App* command =
      app->add_subcommand("record", "A running world to an MCAP file, until Ctrl-C");
  command->add_option("OUTPUT", options->output, "MCAP file; a former one is replaced")->required();
  command->add_option("--seconds", options->seconds, "End after so many seconds, up to 1e7")
      ->check(Finite(kRecordSecondsMax, false));
  command->add_flag("!--no-watch", options->watch,
                    "Do not ask simulators for fresh states at --rate meanwhile");
  AddRateOption(command, "How often the channels for the page and Foxglove are written",
                &options->rate_hz);
  command->footer(std::string(kRecordFooter) + kMcapFooter);
  return command;
}

int RunConvert(const ConvertOptions& options) {
  std::unique_ptr<ReplayedWorld> replayed;
  try {
    CheckOutput(options.output, options.input);
    replayed =
        std::make_unique<ReplayedWorld>(ReplayOf(options.input, options.from, options.until));
    if (!replayed->Begin()) return replayed->Finish();  // no recording: a former file stays
  } catch (const BadInput& error) {
    return FailWith(error.what(), kExitUsage);
  } catch (const std::runtime_error& error) {
    return FailWith(error.what(), kExitNoInput);
  }
  try {
    ReplayedWorld& world = *replayed;
    WorldRecorder recorder(std::move(replayed), {.path = options.output,
                                                 .rate_hz = options.rate_hz,
                                                 .wall_ns = [&world] { return world.wall_ns(); }});
    Progress progress("convert");
    CatchStopSignals();
    while (!world.is_over() && !StopRequested()) {
      recorder.Poll({});
      progress.Tell(recorder.now_ns());
    }
    // The replay is stopped by the same Ctrl-C.
    const bool is_stopped = StopRequested() || !world.is_over();
    recorder.Close();
    PrintFiles(recorder);
    if (is_stopped) return FailWith("stopped: the rest of the recording is missing", kExitRefused);
    return world.Finish();
  } catch (const std::runtime_error& error) {
    return FailWith(error.what(), kExitOutputFailed);
  }
}

int RunRecord(const ConvertOptions& options, const MonitorOptions& place, double timeout_s) {
  using Clock = std::chrono::steady_clock;
  std::unique_ptr<Receiver> receiver;
  std::unique_ptr<AgentsWatcher> watcher;
  try {
    MonitorOptions all = place;
    all.simulators = true;
    std::cerr << "collisionctl: " << PlaceText(place.world, place.domain) << '\n';
    receiver = ConnectMonitor(all);
    if (options.watch) {
      watcher = std::make_unique<AgentsWatcher>(
          ConnectWatcher({place.world, place.domain, place.credentials}),
          std::clamp(Nanoseconds(1 / options.rate_hz),
                     std::chrono::nanoseconds(wire::kWatchPeriodMin),
                     std::chrono::nanoseconds(wire::kWatchPeriodMax)));
    }
  } catch (const std::runtime_error& error) {
    return FailWith(error.what(), kExitUnavailable);
  }
  try {
    WorldRecorder recorder(std::move(receiver),
                           {.path = options.output, .rate_hz = options.rate_hz, .wall_ns = [] {
                              return std::chrono::duration_cast<std::chrono::nanoseconds>(
                                         std::chrono::system_clock::now().time_since_epoch())
                                  .count();
                            }});
    CatchStopSignals();
    const Clock::time_point begin = Clock::now();
    const auto is_due = [begin](double seconds) {
      return Clock::now() - begin >= Nanoseconds(seconds);
    };
    Progress progress("record");
    while (!StopRequested() && (options.seconds == 0 || !is_due(options.seconds))) {
      if (watcher) watcher->Repeat(Clock::now());
      recorder.Poll(kWaitMax);
      progress.Tell(recorder.now_ns());
      if (!recorder.view().status() && is_due(timeout_s)) break;
    }
    const bool has_service = recorder.view().status().has_value();
    recorder.Close();
    PrintFiles(recorder);
    if (has_service) return kExitOk;
    return FailWith("no service was heard: is the world right? see collisionctl doctor",
                    kExitUnavailable);
  } catch (const std::runtime_error& error) {
    return FailWith(error.what(), kExitOutputFailed);
  }
}

}  // namespace collision::client
