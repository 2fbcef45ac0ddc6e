#include "client/programs/tools/collisionctl/health.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <stdexcept>

#include "client/library/deadline.h"
#include "client/library/network/dds_transport.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "client/programs/tools/collisionctl/status/verdict.h"

namespace collision::client {
namespace {

/// Those of which samples were refused between two statuses.
std::string RefusedBetween(const v1::ServiceStatus& before, const v1::ServiceStatus& after) {
  std::map<std::uint64_t, std::uint64_t> refused;
  for (const v1::SimulatorStatus& simulator : before.simulators()) {
    refused[simulator.simulator_id()] = simulator.rejected();
  }
  std::string names;
  for (const v1::SimulatorStatus& simulator : after.simulators()) {
    const auto known = refused.find(simulator.simulator_id());
    const std::uint64_t least = known == refused.end() ? 0 : known->second;
    if (simulator.rejected() > least) names += (names.empty() ? "" : ", ") + simulator.name();
  }
  return names;
}

/// A service that serves is not critical: to start it again would mend nothing, also where it FAILS
/// to keep what it should.
HealthLevel LevelOf(const std::string& verdict) {
  return verdict.starts_with("WELL") ? HealthLevel::kWell : HealthLevel::kTrouble;
}

/// The first status of a service that serves, and the next one.
std::optional<Health> Judge(const HealthOptions& options, const std::string& place) {
  WorldView view;
  MessageMonitor monitor(ConnectStatusReader({options.world, options.domain, options.credentials}),
                         view.Callbacks());
  const Deadline deadline(std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(options.max_age_s)));
  std::optional<v1::ServiceStatus> before;
  while (deadline.Remaining().count() > 0) {
    monitor.Poll(deadline.Remaining());
    if (!view.status()) continue;
    if (!before) before = *view.status();
    const bool is_next = view.status()->stamp().sequence() != before->stamp().sequence() ||
                         view.status()->service_id() != before->service_id();
    if (is_next) return HealthOf(*before, view, options.simulators_required);
  }
  if (!monitor.unreadable().empty()) return Health{.text = "CRITICAL: " + monitor.unreadable()};
  if (!before && !view.Standbys().empty()) {
    return Health{.text = "CRITICAL: only a standby is heard in " + place};
  }
  if (before) {
    return Health{.text = "CRITICAL: the service of " + place +
                          " tells no new status: it stands still, or has ended"};
  }
  return std::nullopt;
}

}  // namespace

Health HealthOf(const v1::ServiceStatus& before, const WorldView& view,
                std::size_t simulators_required) {
  const v1::ServiceStatus& status = *view.status();
  const auto alive = static_cast<std::size_t>(
      std::ranges::count_if(status.simulators(), [](const auto& one) { return one.alive(); }));
  if (alive < simulators_required) {
    return {HealthLevel::kCritical, "CRITICAL: " + std::to_string(alive) + " of the " +
                                        std::to_string(simulators_required) +
                                        " simulators that are required are alive"};
  }
  const std::string verdict = Verdict(view).front();
  const HealthLevel level = LevelOf(verdict);
  if (level != HealthLevel::kWell) return {level, verdict};
  const std::string refused = RefusedBetween(before, status);
  if (!refused.empty()) {
    return {HealthLevel::kTrouble,
            "REFUSES " + refused + ": collisionctl status says what, and why"};
  }
  return {level, verdict};
}

std::string HealthJson(const Health& health) {
  constexpr const char* kNames[] = {"well", "trouble", "critical"};
  return JsonDocument("health")
      .Text("level", kNames[static_cast<int>(health.level)])
      .Text("text", health.text)
      .Json();
}

CLI::App* AddHealthCommand(CLI::App* app, HealthOptions* options) {
  CLI::App* command = app->add_subcommand(
      "health", "For probes: one sentence, and 0 (well), 1 (trouble) or 2 (critical)");
  command
      ->add_option("--max-age", options->max_age_s,
                   "Seconds within which a new status must come, 0.1 to 60")
      ->check(Between(0.1, 60))
      ->capture_default_str();
  command
      ->add_option("--require-simulators", options->simulators_required,
                   "How many simulators must be alive, 0 to 1024")
      ->check(WholeBetween(0, 1024))
      ->capture_default_str();
  return command;
}

int RunHealth(const HealthOptions& options) {
  const std::string place =
      "world \"" + options.world + "\" on domain " + std::to_string(options.domain);
  Health health{.text = "CRITICAL: no service is heard in " + place};
  try {
    if (const auto judged = Judge(options, place)) health = *judged;
  } catch (const std::runtime_error& error) {
    health.text = std::string("CRITICAL: ") + error.what();
  }
  std::cout << (options.json ? HealthJson(health) : health.text) << std::endl;
  if (!std::cout) return kExitOutputFailed;
  return static_cast<int>(health.level);
}

}  // namespace collision::client
