#include "client/programs/tools/collisionctl/why/agent_lookup.h"

#include <utility>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/status/verdict.h"

namespace collision::client {

std::optional<v1::CollisionEvent> NewestOf(const AgentId& a, const AgentId& b, WorldView* view) {
  std::optional<v1::CollisionEvent> newest;
  for (const v1::CollisionEvent& event : view->TakeEvents()) {
    const AgentId lower = FromMessage(event.lower()), higher = FromMessage(event.higher());
    const bool is_theirs = (lower == a && higher == b) || (lower == b && higher == a);
    if (is_theirs && event.level().empty()) newest = event;
  }
  return newest;
}

AgentView FindAgent(const WorldView& view, const std::string& name) {
  std::vector<AgentView> found;
  std::vector<std::string> found_names, all_names;
  for (AgentView& agent : view.Agents()) {
    const std::string own = view.Name(IdOf(agent));
    const std::string full = view.SimulatorName(agent.description.simulator_id()) + ":" + own;
    all_names.push_back(full);
    if (name != own && name != full) continue;
    found.push_back(std::move(agent));
    found_names.push_back(full);
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    throw NoSuchAgent("no agent \"" + name + "\" in this world; known: " +
                      (all_names.empty() ? "none" : Shortened(all_names, kNamesColumns)));
  }
  throw NoSuchAgent("\"" + name + "\" names " + std::to_string(found.size()) +
                    " agents: " + Shortened(found_names, kNamesColumns));
}

}  // namespace collision::client
