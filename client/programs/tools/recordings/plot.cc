#include "client/programs/tools/recordings/plot.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>

#include "client/programs/chart/chart.h"
#include "client/programs/recordings/replayed_world.h"
#include "client/programs/recordings/temporary_folder.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/tools/recordings/curves.h"
#include "client/programs/tools/recordings/replay_options.h"

namespace collision::client {
namespace {

constexpr std::int64_t kAnewNs = 1'000'000'000;        ///< So far back time does not go otherwise.
constexpr std::int64_t kSamplePeriodNs = 100'000'000;  ///< Of the world's time.

constexpr const char* kPlotFooter = R"(
  clearance  for how long agents certainly touch nothing: the least, a tenth, the median
  brackets   of each contact, what was not yet known of its begin, over the time that was left
  latency    how old states are when the service takes them; in lock-step how long a second of the
             world takes
  pairs      pairs that are tracked, may touch, will if they go on so, and touch

Of a recording in which the world's time begins anew it shows what was before. gnuplot draws it
(gnuplot-nox); of a name that ends in .csv the numbers are written.

Examples:
  collisionctl plot run.rec --what clearance -o clearance.svg
  collisionctl plot /var/lib/collisiond/lab --from 2026-11-29T03:00 --what pairs -o pairs.csv
)";

chart::Chart ChartOf(const PlotOptions& options, int* code) {
  auto replayed =
      std::make_unique<ReplayedWorld>(ReplayOf(options.input, options.from, options.until));
  ReplayedWorld& world = *replayed;
  const auto curves = MakeCurves(options.what, [&world] { return world.wall_ns(); });
  WorldView view;
  MessageMonitor::Callbacks callbacks = view.Callbacks();
  std::int64_t now_ns = std::numeric_limits<std::int64_t>::min(), due_ns = now_ns,
               newest_ns = now_ns;
  const auto also = [](auto* callback, auto more) {
    *callback = [first = *callback, more](const auto& message) {
      if (first) first(message);
      more(message);
    };
  };
  also(&callbacks.event, [&](const v1::CollisionEvent& event) { curves->Take(event); });
  also(&callbacks.states, [&](const v1::AgentStates& states) { curves->Take(states); });
  also(&callbacks.status, [&](const v1::ServiceStatus& status) {
    curves->Take(status);
    now_ns = status.now_ns();
  });
  also(&callbacks.clearance,
       [&](const v1::Clearance& clearance) { now_ns = std::max(now_ns, clearance.now_ns()); });
  MessageMonitor monitor(std::move(replayed), callbacks);
  Progress progress("plot");
  CatchStopSignals();
  while (!world.is_over() && !StopRequested()) {
    monitor.Poll({});
    static_cast<void>(view.TakeEvents());
    if (view.status() && now_ns < newest_ns - kAnewNs && view.status()->agents() > 0) {
      std::cerr << "collisionctl: the world's time begins anew: what follows is left out\n";
      break;
    }
    newest_ns = std::max(newest_ns, now_ns);
    if (!view.status() || now_ns < due_ns) continue;
    due_ns = now_ns + kSamplePeriodNs;
    curves->Sample(now_ns, view);
    progress.Tell(now_ns);
  }
  *code = StopRequested() ? kExitRefused : world.is_over() ? world.Finish() : kExitOk;
  return curves->Draw();
}

std::string PictureOf(const chart::Chart& chart, const std::string& path) {
  if (std::filesystem::path(path).extension() == ".csv") return chart::Csv(chart);
  try {
    return chart::Draw(chart, TemporaryFolder("collisionctl-plot").path());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(error.what()) + " (it comes with gnuplot-nox)");
  }
}

}  // namespace

CLI::App* AddPlotCommand(CLI::App* app, PlotOptions* options) {
  CLI::App* command = app->add_subcommand("plot", "What a recording shows over time, as a picture");
  AddReplayOptions(command, &options->input, &options->from, &options->until);
  command->add_option("--what", options->what, "clearance, brackets, latency or pairs")
      ->required()
      ->check(OneOf({std::begin(kPlotWords), std::end(kPlotWords)}));
  command->add_option("-o,--output", options->output, "SVG, or CSV; a former one is replaced")
      ->required();
  command->footer(kPlotFooter);
  return command;
}

int RunPlot(const PlotOptions& options) {
  int code = kExitOk;
  chart::Chart chart;
  try {
    chart = ChartOf(options, &code);
  } catch (const BadInput& error) {
    return FailWith(error.what(), kExitUsage);
  } catch (const std::runtime_error& error) {
    return FailWith(error.what(), kExitNoInput);
  }
  if (chart.empty()) return FailWith("there is nothing to plot in " + options.input, kExitBadData);
  try {
    const std::string picture = PictureOf(chart, options.output);
    std::ofstream file(options.output, std::ios::binary | std::ios::trunc);
    if (!(file << picture).flush())
      throw std::runtime_error(options.output + ": cannot be written");
  } catch (const std::runtime_error& error) {
    return FailWith(error.what(), kExitOutputFailed);
  }
  std::cout << chart.title << ". " << chart.caption << '\n';
  return code;
}

}  // namespace collision::client
