#include "client/programs/tools/collisionctl/status/status_page.h"

#include <algorithm>
#include <vector>

#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "client/programs/tools/collisionctl/status/verdict.h"
#include "idl/identity.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

constexpr int kFactLines = 7;

std::string ProcessText(const v1::ServiceStatus& status) {
  const std::string process = ExtensionOf(status, std::string(wire::kProcessExtension));
  return process.empty() ? IdText(status.service_id()) : process;
}

std::string ServiceText(const WorldView& view) {
  const v1::ServiceStatus& serving = *view.status();
  std::string text = "version " + serving.version() + ", " + ProcessText(serving) + ", term " +
                     std::to_string(serving.stamp().term());
  std::vector<std::string> standbys;
  for (const v1::ServiceStatus& standby : view.Standbys()) {
    const std::string readiness = ExtensionOf(standby, "standby");
    const bool same = standby.configuration() == serving.configuration();
    standbys.push_back(ProcessText(standby) + (readiness.empty() ? "" : " " + readiness) +
                       (same ? "" : ", of another configuration"));
  }
  if (!standbys.empty()) text += "; standby: " + Shortened(standbys, kNamesColumns);
  return text;
}

std::string WorldText(const v1::ServiceStatus& status) {
  return status.world() + ", " + (status.simulated_clock() ? "lock-step" : "real time") +
         (status.frame().empty() ? "" : ", frame " + status.frame()) +
         (status.epoch_utc().empty() ? "" : ", epoch " + status.epoch_utc()) + ", now " +
         SinceText(status.now_ns());
}

std::string SimulatorsText(const v1::ServiceStatus& status) {
  const std::uint64_t unlisted = CounterOf(status, "simulators_unlisted");
  std::vector<std::string> names, silent;
  for (const v1::SimulatorStatus& simulator : status.simulators()) {
    names.push_back(simulator.name());
    if (!simulator.alive()) silent.push_back(simulator.name());
  }
  const std::string agents = std::to_string(status.agents()) + " agents, " +
                             std::to_string(status.pairs_tracked()) + " pairs tracked";
  if (names.empty()) return "none, " + agents;
  std::string text = std::to_string(names.size() + unlisted) + " (" +
                     Shortened(names, kNamesColumns, unlisted) + "), ";
  if (!silent.empty()) text += "not heard: " + Shortened(silent, kNamesColumns) + ", ";
  return text + agents;
}

/// How many events there have been of each status, and how often a declaration was broken.
std::string EventsText(const v1::ServiceStatus& status) {
  std::string text;
  for (const char* name :
       {"confirmed", "ended", "undecided", "possible", "dismissed", "withdrawn", "breaches"}) {
    const bool is_status = name != std::string("breaches");
    const std::uint64_t count = CounterOf(status, (is_status ? "events_" : "") + std::string(name));
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(is_status ? name : "broken declarations") +
            " " + std::to_string(count);
  }
  return text.empty() ? "none yet" : text;
}

/// As many lines as there is room for beside the facts.
std::string VerdictLines(const WorldView& view) {
  const std::vector<std::string> verdict = Verdict(view);
  constexpr std::size_t kRoom = kStatusLinesMax - kFactLines;
  const std::size_t shown = verdict.size() <= kRoom ? verdict.size() : kRoom - 1;
  std::string lines;
  for (std::size_t i = 0; i < shown; ++i) lines += verdict[i] + "\n";
  if (shown < verdict.size()) {
    lines += "  and " + std::to_string(verdict.size() - shown) + " lines more: --all\n";
  }
  return lines;
}

}  // namespace

std::string StatusPage(const WorldView& view) {
  const v1::ServiceStatus& status = *view.status();
  return VerdictLines(view) + Line("service", ServiceText(view)) +
         Line("world", WorldText(status)) + Line("simulators", SimulatorsText(status)) +
         Line("earliest", EarliestText(view)) + Line("events", EventsText(status)) +
         Line("refused", CountersText(status, true)) + Line("more", "collisionctl status --all");
}

}  // namespace collision::client
