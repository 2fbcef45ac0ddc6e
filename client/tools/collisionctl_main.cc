// collisionctl: what a running world looks like, from outside.
#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>
#include <stdexcept>

#include "client/deadline.h"
#include "client/event_text.h"
#include "client/tools/collisionctl_json.h"
#include "client/tools/collisionctl_text.h"
#include "client/validation.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;

constexpr int kUsage = 2;
constexpr int kUnavailable = 69;          // EX_UNAVAILABLE of sysexits.h.
constexpr milliseconds kQuiet{150};       // Nothing new for so long: the picture is complete.
constexpr milliseconds kFollowWait{250};  // How soon Ctrl-C is noticed.
constexpr int kPollsMax = 8;  // In a world that is never quiet, the picture is complete enough.

volatile std::sig_atomic_t stopped = 0;

struct Options {
  MonitorOptions monitor{.simulators = true};
  double timeout_s = 3;
  bool json = false;
  bool follow = false;
};

/// Gathers what late joiners are given, until `enough` and quiet, or until the time is over.
template <typename Enough>
void Gather(Monitor* monitor, const Deadline& deadline, Enough enough) {
  for (int polls = 0; polls < kPollsMax && stopped == 0 && deadline.Remaining().count() > 0;) {
    const auto wait = std::min<std::chrono::nanoseconds>(kQuiet, deadline.Remaining());
    const bool quiet = monitor->Poll(wait) == 0;
    if (!enough()) continue;
    if (quiet) return;
    ++polls;
  }
}

bool WaitForService(Monitor* monitor, const WorldView& view, const Deadline& deadline) {
  while (!view.status() && stopped == 0) {
    if (deadline.Remaining().count() == 0) return false;
    monitor->Poll(std::min<std::chrono::nanoseconds>(kFollowWait, deadline.Remaining()));
  }
  return view.status().has_value();
}

void PrintEvents(WorldView* view, bool json) {
  const AgentNamer name = [view](const v1::AgentId& id) { return view->Name(id); };
  for (const v1::CollisionEvent& event : view->TakeEvents()) {
    std::cout << (json ? Json(event) : EventLine(event, name, 0)) << '\n';
  }
  std::cout.flush();
}

void Follow(Monitor* monitor, WorldView* view, bool json) {
  bool alive = true;
  while (stopped == 0 && std::cout) {
    monitor->Poll(kFollowWait);
    PrintEvents(view, json);
    if (monitor->service_alive() == alive) continue;
    alive = !alive;
    std::cerr << (alive ? "the service is back\n" : "the service is gone; waiting for it\n");
  }
}

void Print(const std::string& command, const Options& options, WorldView* view) {
  if (command == "events") return PrintEvents(view, options.json);
  if (command == "status") {
    std::cout << (options.json ? Json(*view->status()) + "\n" : StatusPage(*view));
  } else if (command == "agents") {
    std::cout << (options.json ? AgentsJson(*view) + "\n" : AgentsPage(*view));
  } else if (options.json) {
    std::cout << (view->earliest() ? Json(*view->earliest()) : "{}") << '\n';
  } else {
    std::cout << EarliestPage(*view);
  }
}

int Run(const std::string& command, const Options& options) {
  WorldView view;
  Monitor monitor(options.monitor, view.Callbacks());
  const std::chrono::duration<double> timeout(options.timeout_s);
  const Deadline deadline(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  if (!WaitForService(&monitor, view, deadline)) {
    if (stopped != 0) return 0;
    std::cerr << "collisionctl: no service in world \"" << options.monitor.world << "\" on domain "
              << options.monitor.domain << " within " << options.timeout_s << " s\n";
    return kUnavailable;
  }
  Gather(&monitor, deadline, [&view] { return view.knows_all_agents(); });
  Print(command, options, &view);
  if (options.follow) Follow(&monitor, &view, options.json);
  return 0;
}

constexpr const char* kExamples = R"(
Examples:
  collisionctl status                   is it well, who is there, what has been refused
  collisionctl earliest                 who can touch whom first, and not before when
  collisionctl agents                   every agent, and how long it is clear
  collisionctl events                   the current revision of every event
  collisionctl events --follow          one line per revision as it comes, until Ctrl-C
  collisionctl --world lab events --follow --json | jq 'select(.status == "EVENT_CONFIRMED")'

It only reads. The network is that of Cyclone DDS, set by CYCLONEDDS_URI.
Exit codes: 0 done, 2 usage, 69 no service within the timeout or no DDS.)";

int Main(int argc, char** argv) {
  CLI::App app("Shows what collisiond and the simulators of a world publish.", "collisionctl");
  Options options;
  app.add_option("--world", options.monitor.world, "World to look at")->capture_default_str();
  app.add_option("--domain", options.monitor.domain, "DDS domain, 0 to 230")->capture_default_str();
  app.add_option("--timeout", options.timeout_s, "Seconds to wait for a service, 0 to 1e6")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app.add_flag("--json", options.json, "JSON for programs: one document, or one line per event");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(kExamples);
  app.add_subcommand("status", "Service, clock, simulators, broad phase and why, refusals");
  app.add_subcommand("agents", "Table of all agents");
  app.add_subcommand("earliest", "The earliest intersection that is possible now");
  app.add_subcommand("events", "The current events")
      ->add_flag("--follow", options.follow, "Go on with every revision as it comes");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  }
  try {
    ValidateWorld(options.monitor.world, options.monitor.domain);
  } catch (const std::runtime_error& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kUsage;
  }
  const auto stop = [](int) { stopped = 1; };
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  try {
    return Run(app.get_subcommands().front()->get_name(), options);
  } catch (const std::runtime_error& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kUnavailable;
  }
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) { return collision::client::Main(argc, argv); }
