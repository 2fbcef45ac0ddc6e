#include "client/programs/tools/suggest_bounds/command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "client/library/deadline.h"
#include "client/library/network/dds_transport.h"
#include "client/library/network/message_monitor.h"
#include "client/library/notices/notices.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/tools/collisionctl/agents_watcher.h"
#include "client/programs/tools/suggest_bounds/bounds_page.h"
#include "client/programs/tools/suggest_bounds/motion_file.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

constexpr std::chrono::milliseconds kPoll{50};
constexpr double kLiveSecondsMax = 86400;
constexpr double kMarginMax = 10;
constexpr double kLookAheadSecondsMax = 86400;

constexpr const char* kBoundsFooter = R"(
Examples:
  collisionctl suggest-bounds tracks.csv             the columns of trajectory-player
  collisionctl suggest-bounds run.rec                what collisiond --record wrote
  collisionctl suggest-bounds --live --seconds 60    the agents of a running world
  collisionctl suggest-bounds run.rec --quantile 0.999 --margin 0.5

Between two rows or states the motion is taken to be the cubic curve through their positions and
velocities. For rows the bounds are a proof of that curve, as long as all of it counts (--quantile
1). For states of a run they are an estimate: the agent moved otherwise between them, and the next
run differs, so a margin is added. What a bound must cover and the run did not show, such as an
emergency stop, only its maker knows. Noise in positions looks like acceleration: declare it as
position_error and smooth it before.
Exit codes: 0 done, 2 usage, 65 the file is malformed, 66 it cannot be read, 69 no service or no
states, 74 the output cannot be written.)";

/// What was seen, or the exit code of what went wrong.
struct Seen {
  BoundsSource source;
  std::vector<SampledAgent> agents;
  int exit_code = kExitOk;
};

Seen Failed(const std::string& what, int exit_code) {
  std::cerr << "collisionctl: " << what << '\n';
  return {{}, {}, exit_code};
}

std::chrono::nanoseconds AsNanoseconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

Seen ReadFile(const std::string& path) {
  try {
    MotionFile file = ReadMotionFile(path);
    if (!file.warning.empty()) std::cerr << "collisionctl: " << file.warning << '\n';
    return {{path, file.is_recording ? "recording" : "csv"}, std::move(file.agents)};
  } catch (const BadInput& error) {
    return Failed(error.what(), kExitBadData);
  } catch (const std::runtime_error& error) {
    return Failed(error.what(), kExitNoInput);
  }
}

/// Collects until the deadline or Ctrl-C.
void Collect(MessageMonitor* monitor, const MotionSamples& samples,
             const SuggestBoundsOptions& options, const LiveWorld& live) {
  AgentsWatcher watcher(ConnectWatcher({live.world, live.domain, live.credentials}),
                        AsNanoseconds(options.period_s));
  const Deadline deadline(AsNanoseconds(options.seconds));
  while (deadline.Remaining().count() > 0 && !samples.full() && !StopRequested()) {
    watcher.Repeat(std::chrono::steady_clock::now());
    monitor->Poll(std::min<std::chrono::nanoseconds>(kPoll, deadline.Remaining()));
  }
}

Seen Watch(const SuggestBoundsOptions& options, const LiveWorld& live) {
  std::cerr << "collisionctl: " << PlaceText(live.world, live.domain) << '\n';
  MotionSamples samples;
  bool has_service = false;
  MessageMonitor::Callbacks callbacks;
  callbacks.status = [&](const v1::ServiceStatus&) { has_service = true; };
  callbacks.description = [&](const v1::AgentDescription& message) { samples.Take(message); };
  callbacks.states = [&](const v1::AgentStates& message) { samples.Take(message); };
  MonitorOptions monitored;
  monitored.world = live.world;
  monitored.domain = live.domain;
  monitored.credentials = live.credentials;
  monitored.simulators = true;
  MessageMonitor monitor(monitored, callbacks);
  const Deadline deadline(AsNanoseconds(live.timeout_s));
  while (!has_service && deadline.Remaining().count() > 0 && !StopRequested()) {
    monitor.Poll(std::min<std::chrono::nanoseconds>(kPoll, deadline.Remaining()));
  }
  if (!has_service) {
    return Failed("no service in world \"" + live.world + "\" on domain " +
                      std::to_string(live.domain) + " in time; --timeout sets how long to wait",
                  kExitUnavailable);
  }
  Collect(&monitor, samples, options, live);
  if (samples.full()) {
    std::cerr << "collisionctl: " << MotionSamples::kSamplesMax
              << " states have come; later ones do not count\n";
  }
  if (samples.refused() > 0) std::cerr << "collisionctl: " << samples.first_refusal() << '\n';
  if (samples.samples() == 0) return Failed("no state of any agent has come", kExitUnavailable);
  return {{"world \"" + live.world + "\"", "live"}, samples.Agents()};
}

}  // namespace

CLI::App* AddSuggestBoundsCommand(CLI::App* app, SuggestBoundsOptions* options) {
  CLI::App* command = app->add_subcommand(
      "suggest-bounds", "Which bounds agents keep: of a CSV file, a recording or a live world");
  CLI::Option* file = command->add_option("FILE", options->file, "CSV file or recording");
  CLI::Option* live =
      command->add_flag("--live", options->live, "The agents of the world, for some seconds");
  live->excludes(file);
  command->add_option("--seconds", options->seconds, "Of a live world")
      ->check(Finite(kLiveSecondsMax, false))
      ->needs(live)
      ->capture_default_str();
  command
      ->add_option("--period", options->period_s,
                   "Meanwhile simulators send states at least so often [s], 0.02 to 3600")
      ->check(Between(1e-9 * wire::kWatchPeriodMin, 1e-9 * wire::kWatchPeriodMax))
      ->needs(live)
      ->capture_default_str();
  command
      ->add_option("--quantile", options->request.quantile,
                   "Share of the pieces between two states that keep the bounds; 1: all")
      ->check(Finite(1, false))
      ->capture_default_str();
  command
      ->add_option("--margin", options->request.margin,
                   "Added, as a share, where the bounds are no proof")
      ->check(Finite(kMarginMax, true))
      ->capture_default_str();
  command
      ->add_option("--look-ahead", options->request.look_ahead_s,
                   "With or without a known acceleration: compare the bounds after this [s]")
      ->check(Finite(kLookAheadSecondsMax, false))
      ->capture_default_str();
  command->footer(kBoundsFooter);
  return command;
}

int RunSuggestBounds(const SuggestBoundsOptions& options, const LiveWorld& live, bool json) {
  if (options.file.empty() && !options.live) {
    std::cerr
        << "collisionctl: suggest-bounds: FILE: not given, allowed: a CSV file or a recording, "
           "or --live\n";
    return kExitUsage;
  }
  CatchStopSignals();
  Seen seen;
  try {
    seen = options.live ? Watch(options, live) : ReadFile(options.file);
  } catch (const std::runtime_error& error) {
    seen = Failed(error.what(), kExitUnavailable);
  }
  if (seen.exit_code != kExitOk) return seen.exit_code;
  BoundsRequest request = options.request;
  request.is_curve = seen.source.kind == "csv";
  std::vector<SuggestedBounds> all;
  for (const SampledAgent& agent : seen.agents) all.push_back(SuggestBounds(agent, request));
  std::cout << (json ? BoundsJson(seen.source, all, request)
                     : BoundsPage(seen.source, all, request));
  std::cout.flush();
  if (std::cout) return kExitOk;
  std::cerr << "collisionctl: the output cannot be written\n";
  return kExitOutputFailed;
}

}  // namespace collision::client
