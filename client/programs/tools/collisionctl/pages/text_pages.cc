#include "client/programs/tools/collisionctl/pages/text_pages.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string_view>
#include <utility>

#include "client/library/network/conversion.h"
#include "collision/event_text.h"
#include "collision/shape.h"
#include "collision/types.h"

namespace collision::client {
namespace {

std::string PositionText(const v1::Vector3& p) {
  return NumberText(p.x(), "%.3f") + " " + NumberText(p.y(), "%.3f") + " " +
         NumberText(p.z(), "%.3f");
}

/// The first digits of the hash, enough to tell the few shapes of a world apart.
std::string ShapeText(const std::string& hash) {
  constexpr std::size_t kBytesShown = 4;
  return HexText(hash.substr(0, kBytesShown));
}

std::string BodyText(const v1::AgentDescription& description) {
  if (description.has_half_space()) return "half-space";
  return description.shape_hash().empty() ? "ball" : ShapeText(description.shape_hash());
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
  const bool described = IsDescribed(description);
  std::vector<std::string> row = {
      description.simulator_name() + ":" + std::to_string(description.slot()) + "." +
          std::to_string(description.generation()),
      description.agent_name().empty() ? "-" : description.agent_name(),
      described ? BodyText(description) : "-",
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
  if (description.hypothetical()) row.back() += ", hypothetical";
  return row;
}

/// A line for each agent that broke what it declared.
std::string BreachLines(const std::vector<AgentView>& agents, const WorldView& view) {
  constexpr std::size_t kLinesMax = 20;
  std::string lines;
  std::size_t broken = 0;
  for (const AgentView& agent : agents) {
    if (!agent.breach || ++broken > kLinesMax) continue;
    const auto name = [&view](const AgentId& id) { return view.FullName(id); };
    lines += BreachText(FromMessage(*agent.breach), name, 0) + "\n";
  }
  if (broken > kLinesMax) lines += "and " + std::to_string(broken - kLinesMax) + " more\n";
  return lines;
}

}  // namespace

std::string SinceText(std::int64_t instant_ns) {
  if (instant_ns == std::numeric_limits<std::int64_t>::min()) return "-";
  return InstantText(instant_ns, 0, 3);
}

std::string EarliestText(const WorldView& view) {
  const auto& earliest = view.earliest();
  if (!earliest) return "not published yet";
  if (!earliest->found()) return "never: no two agents can touch that are not in contact already";
  return "not before " + InstantText(earliest->earliest_ns(), 0, 6) + "  " +
         view.Name(FromMessage(earliest->lower())) + " × " +
         view.Name(FromMessage(earliest->higher()));
}

std::string NumberText(double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string AgentsPage(const WorldView& view) {
  std::vector<std::vector<std::string>> rows = {
      {"ID", "NAME", "SHAPE", "RADIUS [m]", "M [m/s²]", "STATE AT", "POSITION [m]", "CLEAR UNTIL"}};
  const std::vector<AgentView> agents = view.Agents();
  for (const AgentView& agent : agents) rows.push_back(AgentRow(agent));
  std::string page = Table(rows) + BreachLines(agents, view);
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
