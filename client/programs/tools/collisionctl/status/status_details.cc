#include "client/programs/tools/collisionctl/status/status_details.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "client/programs/tools/collisionctl/status/status_measurements.h"
#include "client/programs/tools/collisionctl/status/verdict.h"
#include "collision/event_text.h"
#include "idl/identity.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

/// The number of queries to the broad phase, and of events that wait for their time.
std::string QueriesText(const v1::ServiceStatus& status) {
  return std::to_string(CounterOf(status, "queries_per_second")) + " a second, " +
         std::to_string(CounterOf(status, "queries")) + " so far; " +
         std::to_string(CounterOf(status, "queued")) + " events in the queue";
}

/// How many states stayed inside the promised bounds, so that no query was needed.
std::string UpdatesText(const v1::ServiceStatus& status) {
  const std::uint64_t kept = CounterOf(status, "updates_kept");
  std::uint64_t all = kept;
  for (const char* name : {"discontinuities", "widenings", "breaches"}) {
    all += CounterOf(status, name);
  }
  if (all == 0) return "none so far";
  const double share = 100 * static_cast<double>(kept) / static_cast<double>(all);
  return std::to_string(kept) + " of " + std::to_string(all) + " cost nothing (" +
         NumberText(share, "%.1f") + " %)";
}

/// Number and size of the trees, and how many came from the cache; empty without any.
std::string TreesText(const v1::ServiceStatus& status) {
  const auto count = [&](const char* name) { return CounterOf(status, name); };
  if (count("shapes") + count("trees_building") == 0) return "";
  std::string text =
      std::to_string(count("shapes")) + ", " + std::to_string(count("tree_nodes")) + " balls";
  const std::string builder = ExtensionOf(status, "tree_builder");
  if (!builder.empty()) text += " (" + builder + ")";
  text += NumberText(static_cast<double>(count("tree_bytes")) / 1e6, ", %.1f MB; ") +
          std::to_string(count("trees_building")) + " being built; ";
  const std::uint64_t looked =
      count("tree_cache_hits") + count("tree_cache_misses") + count("tree_cache_discarded");
  if (looked == 0) return text + "no cache used";
  return text + std::to_string(count("tree_cache_hits")) + " of " + std::to_string(looked) +
         " from the cache";
}

/// The simulator's clock less the service's: "-0.215 … +0.402 ms".
std::string OffsetText(const v1::SimulatorStatus& simulator) {
  if (!simulator.has_clock_offset()) return "-";
  const v1::TimeBracket& offset = simulator.clock_offset();
  const bool has_lower = offset.earliest_ns() != std::numeric_limits<std::int64_t>::min();
  const bool has_upper = offset.latest_ns() != kNever;
  if (!has_lower && !has_upper) return "-";
  const auto end = [](bool is_known, std::int64_t ns) {
    return is_known ? NumberText(1e-6 * static_cast<double>(ns), "%+.3f") : std::string("?");
  };
  return end(has_lower, offset.earliest_ns()) + " … " + end(has_upper, offset.latest_ns()) + " ms";
}

/// A row for each simulator that the world waits for and that is not listed: it has not come back
/// to a service that started again. Only a name of a simulator is without a blank.
void AddMissing(const v1::ServiceStatus& status, std::vector<std::vector<std::string>>* rows) {
  constexpr std::size_t kAliveColumn = 2;
  for (const std::string& name : Parts(ExtensionOf(status, "waiting_for"))) {
    const auto is_it = [&name](const auto& row) { return row.front() == name; };
    if (name.find(' ') != std::string::npos || std::any_of(rows->begin(), rows->end(), is_it)) {
      continue;
    }
    rows->emplace_back(rows->front().size(), "-").front() = name;
    if (CounterOf(status, "simulators_unlisted") == 0) rows->back()[kAliveColumn] = "missing";
  }
}

std::string RefusedText(const v1::SimulatorStatus& simulator) {
  if (simulator.refused_now() == 0) return "-";
  return std::to_string(simulator.refused_now()) + ": " + simulator.refused_why();
}

std::string SimulatorsTable(const v1::ServiceStatus& status) {
  std::vector<std::vector<std::string>> rows = {{"SIMULATOR", "RUN", "ALIVE", "CLOCK", "GRANTED",
                                                 "AGENTS", "STATES", "REJECTED", "REFUSED NOW"}};
  if (!status.simulated_clock()) rows.front().push_back("OFFSET");
  for (const v1::SimulatorStatus& simulator : status.simulators()) {
    rows.push_back({simulator.name(), std::to_string(simulator.run()),
                    simulator.alive() ? "yes" : "no", SinceText(simulator.clock_ns()),
                    SinceText(simulator.granted_until_ns()), std::to_string(simulator.agents()),
                    std::to_string(simulator.states()), std::to_string(simulator.rejected()),
                    RefusedText(simulator)});
    if (!status.simulated_clock()) rows.back().push_back(OffsetText(simulator));
  }
  AddMissing(status, &rows);
  return Table(rows);
}

/// An extension of the status that has a line of its own.
struct Note {
  const char* label;
  const char* key;
};

constexpr Note kFacts[] = {
    {"clock set", "clock_step"}, {"evicted", "evicted"}, {"removed", "removed_silent"}};

/// A line for each that the status has.
std::string Facts(const v1::ServiceStatus& status) {
  std::string lines;
  for (const auto& [label, key] : kFacts) {
    const std::string text = ExtensionOf(status, key);
    if (!text.empty()) lines += Line(label, text);
  }
  return lines;
}

std::string VerdictText(const WorldView& view) {
  std::string text;
  for (const std::string& line : Verdict(view)) text += line + "\n";
  return text;
}

/// A row for the service in force and for each that stands by.
std::string ServicesTable(const WorldView& view) {
  const v1::ServiceStatus& serving = *view.status();
  std::vector<std::vector<std::string>> rows = {
      {"ROLE", "SERVICE", "PROCESS", "VERSION", "TERM", "LEASE", "AGENTS", "NOW", "CONFIGURATION"}};
  const auto add = [&](const std::string& role, const v1::ServiceStatus& status, const char* note) {
    const auto known = [](const std::string& text) { return text.empty() ? "-" : text; };
    const std::string lease = ExtensionOf(status, "lease_s");
    rows.push_back({role, IdText(status.service_id()),
                    known(ExtensionOf(status, std::string(wire::kProcessExtension))),
                    known(status.version()), std::to_string(status.stamp().term()),
                    known(lease.empty() ? lease : lease + " s"), std::to_string(status.agents()),
                    SinceText(status.now_ns()), note});
  };
  add("serves", serving, "-");
  for (const v1::ServiceStatus& standby : view.Standbys()) {
    const bool same = standby.configuration() == serving.configuration();
    const std::string readiness = ExtensionOf(standby, "standby");
    add(readiness.empty() ? "standby" : "standby, " + readiness, standby,
        same ? "the same" : "OTHER");
  }
  return Table(rows);
}

}  // namespace

std::string StatusDetails(const WorldView& view) {
  const v1::ServiceStatus& status = *view.status();
  std::string page =
      VerdictText(view) + "\n" + ServicesTable(view) + "\n" + Line("world", status.world()) +
      Line("clock", status.simulated_clock() ? "lock-step" : "real time") +
      (status.frame().empty() ? "" : Line("frame", status.frame())) +
      (status.epoch_utc().empty() ? "" : Line("epoch", status.epoch_utc())) +
      Line("now", SinceText(status.now_ns())) + Facts(status) +
      Line("agents", std::to_string(status.agents()) + ", " +
                         std::to_string(status.pairs_tracked()) + " pairs tracked") +
      Line("earliest", EarliestText(view)) +
      Line("broad phase", status.broad_phase() + (status.broad_phase_why().empty() ? "" : ": ") +
                              status.broad_phase_why()) +
      Line("queries", QueriesText(status)) + Line("updates", UpdatesText(status));
  const std::string trees = TreesText(status);
  if (!trees.empty()) page += Line("trees", trees);
  page += MeasurementLines(status);
  std::string label = "left out";
  for (const std::string& what : status.left_out()) {
    page += Line(std::exchange(label, ""), what);
  }
  page += Line("rejections", CountersText(status, true));
  page += Line("counters", CountersText(status, false));
  return page + "\n" + SimulatorsTable(status);
}

}  // namespace collision::client
