// How many messages the swarm needs, from the report of ./run demo swarm.
#include <cctype>
#include <fstream>
#include <iterator>

#include "tests/bench/broad_phase/parts.h"

namespace collision::bench {
namespace {

/// The number behind the first "name":, or nothing.
std::optional<double> NumberAfter(const std::string& json, const std::string& name) {
  const auto at = json.find("\"" + name + "\"");
  if (at == std::string::npos) return std::nullopt;
  const auto colon = json.find(':', at);
  if (colon == std::string::npos) return std::nullopt;
  try {
    return std::stod(json.substr(colon + 1, 40));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

void SwarmPart(const Settings& settings, Report* report) {
  std::optional<double> ratio;
  if (!settings.swarm_report.empty()) {
    std::ifstream file(settings.swarm_report);
    const std::string json{std::istreambuf_iterator<char>(file), {}};
    ratio = NumberAfter(json, "messageRatio");
    if (!ratio) ratio = NumberAfter(json, "message_ratio");
  }
  report->Figure("swarm_message_ratio", ratio);
}

}  // namespace collision::bench
