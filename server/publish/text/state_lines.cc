#include "server/publish/text/state_lines.h"

#include <google/protobuf/util/json_util.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace collision::server {
namespace {

std::string Count(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string Seconds(Instant instant) {
  if (instant.is_never()) return "never";
  if (instant == Instant::Always()) return "unknown";
  return fmt::format("{:.3f} s", 1e-9 * static_cast<double>(instant.nanoseconds()));
}

std::string NextContact(const World& world, const detection::EarliestAnswer& earliest) {
  if (!world.started()) return "time has not begun";
  if (!earliest.found) return "no contact is possible";
  const double ahead = 1e-9 * (static_cast<double>(earliest.earliest.nanoseconds()) -
                               static_cast<double>(world.now().nanoseconds()));
  return fmt::format("next contact not before {:.1f} s",
                     std::max(0.0, std::floor(10 * ahead) / 10));
}

std::string AgentLine(const Simulator& simulator, std::uint32_t slot, const Agent& agent) {
  const auto& clearances = simulator.agents().clearances().all();
  const auto clearance = clearances.find(slot);
  return fmt::format(
      "agent \"{}\" of \"{}\", slot {} generation {}: newest state {}, {}, {} breaches",
      agent.label ? agent.label->agent_name() : "", simulator.name(), slot, agent.generation(),
      Seconds(agent.stamp()),
      clearance == clearances.end() ? "without a clearance"
                                    : "clear until " + Seconds(clearance->second.clear_until),
      agent.breaches);
}

}  // namespace

std::string StatusLine(const World& world, std::size_t agents,
                       const detection::EarliestAnswer& earliest) {
  const auto simulators = std::ranges::count_if(
      world.simulators(), [](const auto& one) { return !one.second.has_left(); });
  return fmt::format("{}, {}, {}", Count(static_cast<std::size_t>(simulators), "simulator"),
                     Count(agents, "agent"), NextContact(world, earliest));
}

std::vector<std::string> StateLines(const v1::ServiceStatus& status, const World& world,
                                    std::size_t agents_max) {
  std::vector<std::string> lines(1);
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  if (!google::protobuf::util::MessageToJsonString(status, &lines[0], options).ok()) {
    lines[0] = "the status cannot be printed";
  }
  std::size_t agents = 0;
  for (const auto& one : world.simulators()) {
    const Simulator& simulator = one.second;
    simulator.agents().ForEachSlot([&](std::uint32_t slot) {
      const Agent* agent = simulator.agents().Find(slot);
      if (agent == nullptr || ++agents > agents_max) return;
      lines.push_back(AgentLine(simulator, slot, *agent));
    });
  }
  if (agents > agents_max) lines.push_back(fmt::format("and {} more agents", agents - agents_max));
  return lines;
}

}  // namespace collision::server
