#include "client/programs/tools/collisionctl/text_pages.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string_view>
#include <utility>

#include "client/api/event_text.h"
#include "client/api/shape.h"
#include "client/api/types.h"
#include "client/library/network/conversion.h"

namespace collision::client {
namespace {

constexpr std::size_t kLabelColumns = 13;

std::string Line(const std::string& label, const std::string& text) {
  return Padded(label, kLabelColumns) + text + "\n";
}

/// A grant or clearance that was never given is the least instant.
std::string SinceText(std::int64_t instant_ns) {
  if (instant_ns == std::numeric_limits<std::int64_t>::min()) return "-";
  return InstantText(instant_ns, 0, 3);
}

std::string PositionText(const v1::Vector3& p) {
  return NumberText(p.x(), "%.3f") + " " + NumberText(p.y(), "%.3f") + " " +
         NumberText(p.z(), "%.3f");
}

std::string EarliestText(const WorldView& view) {
  const auto& earliest = view.earliest();
  if (!earliest) return "not published yet";
  if (!earliest->found()) return "never: no two agents can touch that are not in contact already";
  return "not before " + InstantText(earliest->earliest_ns(), 0, 6) + "  " +
         view.Name(FromMessage(earliest->lower())) + " × " +
         view.Name(FromMessage(earliest->higher()));
}

constexpr const char* kRejected = "rejected_";

/// The counters of refusals, or all others; without those that are 0.
std::string CountersText(const v1::ServiceStatus& status, bool rejections) {
  std::string text;
  for (const v1::Counter& counter : status.counters()) {
    const bool is_rejection = counter.name().rfind(kRejected, 0) == 0;
    if (counter.value() == 0 || is_rejection != rejections) continue;
    const std::string name =
        rejections ? counter.name().substr(std::string(kRejected).size()) : counter.name();
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(counter.value());
  }
  return text.empty() ? "none" : text;
}

std::uint64_t CounterOf(const v1::ServiceStatus& status, const std::string& name) {
  for (const v1::Counter& counter : status.counters()) {
    if (counter.name() == name) return counter.value();
  }
  return 0;
}

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
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == "tree_builder") text += " (" + extension.value() + ")";
  }
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

std::string ExtensionOf(const v1::ServiceStatus& status, const std::string& key) {
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == key) return extension.value();
  }
  return "";
}

/// The parts of a list in an extension: kListSeparator is between them.
std::vector<std::string> Parts(const std::string& list) {
  constexpr std::string_view kListSeparator = ", ";
  std::vector<std::string> parts;
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t to = std::min(list.find(kListSeparator, from), list.size());
    parts.push_back(list.substr(from, to - from));
    from = to + kListSeparator.size();
  }
  return parts;
}

/// For whom the world's time waits, and why, one a line; empty if it does not.
std::string WaitingLines(const v1::ServiceStatus& status) {
  const std::string names = ExtensionOf(status, "waiting_for");
  if (names.empty()) return "";
  std::string lines = Line("TIME STANDS", "it waits for: " + names);
  for (const std::string& why : Parts(ExtensionOf(status, "waiting_why"))) lines += Line("", why);
  return lines;
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

std::string SimulatorsTable(const v1::ServiceStatus& status) {
  std::vector<std::vector<std::string>> rows = {
      {"SIMULATOR", "RUN", "ALIVE", "CLOCK", "GRANTED", "AGENTS", "STATES", "REJECTED"}};
  if (!status.simulated_clock()) rows.front().push_back("OFFSET");
  for (const v1::SimulatorStatus& simulator : status.simulators()) {
    rows.push_back({simulator.name(), std::to_string(simulator.run()),
                    simulator.alive() ? "yes" : "no", SinceText(simulator.clock_ns()),
                    SinceText(simulator.granted_until_ns()), std::to_string(simulator.agents()),
                    std::to_string(simulator.states()), std::to_string(simulator.rejected())});
    if (!status.simulated_clock()) rows.back().push_back(OffsetText(simulator));
  }
  AddMissing(status, &rows);
  return Table(rows);
}

/// The first digits of the hash, enough to tell the few shapes of a world apart.
std::string ShapeText(const std::string& hash) {
  constexpr std::size_t kBytesShown = 4;
  if (hash.empty()) return "ball";
  return HexText(hash.substr(0, kBytesShown));
}

/// What follows the clearance of an agent that is not simply there.
const char* PresenceText(AgentPresence presence) {
  switch (presence) {
    case AgentPresence::kHeld:
      return "";
    case AgentPresence::kSilent:
      return ", held: its simulator is not heard";
    case AgentPresence::kWaitedFor:
      return ", held: its simulator is not heard, time waits for it";
    case AgentPresence::kNotHeld:
      return ", not held by the service";
    case AgentPresence::kEvicted:
      return ", not held: evicted";
    case AgentPresence::kRemovedSilent:
      return ", not held: removed as silent";
  }
  return "";
}

std::vector<std::string> AgentRow(const AgentView& agent) {
  const v1::AgentDescription& description = agent.description;
  const bool described = description.radius_m() > 0;
  std::vector<std::string> row = {
      description.simulator_name() + ":" + std::to_string(description.slot()) + "." +
          std::to_string(description.generation()),
      description.agent_name().empty() ? "-" : description.agent_name(),
      described ? ShapeText(description.shape_hash()) : "-",
      described ? NumberText(description.radius_m(), "%.6g") : "-",
      described ? NumberText(description.acceleration_max_m_s2(), "%.6g") : "-"};
  row.push_back(agent.state ? SinceText(agent.state->stamp_ns()) : "-");
  row.push_back(agent.state ? PositionText(agent.state->position_m()) : "-");
  if (!agent.clearance || !IsHeld(agent)) {
    row.push_back("-");
  } else {
    row.push_back(SinceText(agent.clearance->clear_until_ns()) +
                  (agent.clearance->saturated()   ? " saturated"
                   : agent.clearance->not_clear() ? " not clear"
                                                  : ""));
  }
  row.back() += PresenceText(agent.presence);
  return row;
}

}  // namespace

std::string NumberText(double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string StandbyLines(const WorldView& view) {
  std::string lines;
  for (const v1::ServiceStatus& standby : view.Standbys()) {
    lines += Line("standby", "collisiond " + standby.version() + ", id " +
                                 std::to_string(standby.service_id()) + ", " +
                                 std::to_string(standby.agents()) + " agents, now " +
                                 SinceText(standby.now_ns()));
  }
  return lines;
}

std::string StatusPage(const WorldView& view) {
  const v1::ServiceStatus& status = *view.status();
  std::string page =
      WaitingLines(status) +
      Line("service", "collisiond " + status.version() + ", id " +
                          std::to_string(status.service_id()) + ", term " +
                          std::to_string(status.stamp().term())) +
      StandbyLines(view) + Line("world", status.world()) +
      Line("clock", status.simulated_clock() ? "simulated" : "wall") +
      Line("now", SinceText(status.now_ns())) +
      Line("agents", std::to_string(status.agents()) + ", " +
                         std::to_string(status.pairs_tracked()) + " pairs tracked") +
      Line("earliest", EarliestText(view)) +
      Line("broad phase", status.broad_phase() + (status.broad_phase_why().empty() ? "" : ": ") +
                              status.broad_phase_why()) +
      Line("queries", QueriesText(status)) + Line("updates", UpdatesText(status));
  const std::string trees = TreesText(status);
  if (!trees.empty()) page += Line("trees", trees);
  std::string label = "left out";
  for (const std::string& what : status.left_out()) {
    page += Line(std::exchange(label, ""), what);
  }
  page += Line("rejections", CountersText(status, true));
  page += Line("counters", CountersText(status, false));
  return page + "\n" + SimulatorsTable(status);
}

std::string AgentsPage(const WorldView& view) {
  std::vector<std::vector<std::string>> rows = {
      {"ID", "NAME", "SHAPE", "RADIUS [m]", "M [m/s²]", "STATE AT", "POSITION [m]", "CLEAR UNTIL"}};
  for (const AgentView& agent : view.Agents()) rows.push_back(AgentRow(agent));
  std::string page = Table(rows);
  for (const UnknownAgents& unknown : view.Unknown()) {
    page += "and " + std::to_string(unknown.agents) + " held of " + unknown.simulator +
            ", which is not heard: nothing is known of them here\n";
  }
  return page;
}

std::string ShapesPage(const WorldView& view) {
  std::vector<std::vector<std::string>> rows = {
      {"SHAPE", "SIMULATOR", "AGENTS", "TRIANGLES", "SOLIDS", "BYTES", "PARTS"}};
  for (const ShapeView& shape : view.Shapes()) {
    const std::string parts =
        std::to_string(shape.parts_seen.size()) + " of " + std::to_string(shape.parts);
    rows.push_back({ShapeText(shape.hash), shape.simulator, std::to_string(shape.agents),
                    shape.triangles ? std::to_string(*shape.triangles) : "-",
                    shape.solids ? std::to_string(*shape.solids) : "-", std::to_string(shape.bytes),
                    parts});
  }
  return Table(rows);
}

std::string EarliestPage(const WorldView& view) {
  std::string page = EarliestText(view) + "\n";
  if (view.earliest()) page += "as of " + SinceText(view.earliest()->now_ns()) + "\n";
  return page;
}

std::string MissedLine(std::uint64_t more, std::uint64_t so_far) {
  return "contacts missed: " + std::to_string(more) + " (" + std::to_string(so_far) +
         " so far): the network kept no more for this program";
}

std::string ContactsSummary(std::uint64_t told, std::uint64_t missed) {
  return "contacts told: " + std::to_string(told) + ", missed: " + std::to_string(missed);
}

std::string Table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  const auto width = [](const std::string& cell) {
    return std::count_if(cell.begin(), cell.end(), [](char c) { return (c & 0xc0) != 0x80; });
  };
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], static_cast<std::size_t>(width(row[i])));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) text += Padded(row[i], widths[i] + 2);
    text += row.back() + "\n";
  }
  return text;
}

}  // namespace collision::client
