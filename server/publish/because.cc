#include "server/publish/because.h"

#include <optional>
#include <string>

#include "server/publish/inherited_events.h"
#include "server/world/world.h"

namespace collision::server {
namespace {

bool IsFinal(v1::EventStatus status) {
  return status == v1::EVENT_WITHDRAWN || status == v1::EVENT_ENDED ||
         status == v1::EVENT_UNDECIDED;
}

std::optional<std::string> EndOfRun(const EndedRuns& ended, const v1::AgentId& agent) {
  const auto cause = ended.Find(agent.simulator_id(), agent.run());
  if (!cause) return std::nullopt;
  return NameOf(*cause);
}

/// An end that was known before the agent left has nothing to do with it.
bool HasLeft(const DepartedAgents& departed, const v1::AgentId& agent,
             const v1::CollisionEvent& event) {
  const auto told_until = departed.ToldUntil(IdOf(agent));
  if (!told_until) return false;
  return event.status() != v1::EVENT_ENDED || event.end().latest_ns() >= told_until->nanoseconds();
}

}  // namespace

void AddBecause(const World& world, v1::CollisionEvent* event) {
  if (!IsFinal(event->status())) return;
  auto cause = EndOfRun(world.ended_runs(), event->lower());
  if (!cause) cause = EndOfRun(world.ended_runs(), event->higher());
  if (!cause && (HasLeft(world.departed(), event->lower(), *event) ||
                 HasLeft(world.departed(), event->higher(), *event))) {
    cause = "left";
  }
  if (!cause) return;
  v1::KeyValue& extension = *event->add_extensions();
  extension.set_key(kBecause);
  extension.set_value(*cause);
}

}  // namespace collision::server
