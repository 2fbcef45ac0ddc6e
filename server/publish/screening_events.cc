#include "server/publish/screening_events.h"

#include "server/codec/encode.h"
#include "server/codec/hypothetical.h"
#include "server/publish/because.h"

namespace collision::server {
namespace {

/// Of a pair, the one that is hypothetical.
const detection::AgentId& HypotheticalOf(const detection::CollisionEvent& event) {
  return event.lower_side == kHypotheticalSide ? event.lower : event.higher;
}

/// A contact is told once: not as a forecast that came true, too.
bool IsCopy(const Telling& telling) { return !telling.contact && IsContact(telling.event.status); }

}  // namespace

std::vector<v1::ScreeningEvent> ScreeningEvents::Take(
    const std::vector<detection::CollisionEvent>& events, const World& world,
    std::int64_t time_ns) {
  for (const detection::CollisionEvent& event : events) {
    log_.Add(Encode(event));
    labels_.Note(event, world);
  }
  std::vector<v1::ScreeningEvent> messages;
  for (const Telling& telling : filter_.Take(events, world.now(), time_ns)) {
    if (IsCopy(telling)) continue;
    if (auto message = MessageOf(telling.event, world)) messages.push_back(std::move(*message));
  }
  return messages;
}

std::vector<v1::ScreeningEvent> ScreeningEvents::Standing(const World& world) const {
  std::vector<v1::ScreeningEvent> messages;
  for (const Telling& telling : filter_.Standing()) {
    if (auto message = MessageOf(telling.event, world)) messages.push_back(std::move(*message));
  }
  return messages;
}

void ScreeningEvents::Forget() {
  filter_.Forget();
  labels_.Forget();
}

std::optional<v1::ScreeningEvent> ScreeningEvents::MessageOf(const detection::CollisionEvent& event,
                                                             const World& world) const {
  const detection::AgentId& agent = HypotheticalOf(event);
  const auto owner = world.simulators().find(agent.simulator);
  if (owner == world.simulators().end() || owner->second.run() != agent.run) return std::nullopt;
  v1::ScreeningEvent message;
  message.set_simulator_id(agent.simulator);
  message.set_pair_slot(event.pair_slot);
  message.set_run(agent.run);
  message.set_incarnation(owner->second.incarnation());
  *message.mutable_event() = Encode(event);
  AddBecause(world.ended_runs(), message.mutable_event());
  AddLabels(labels_.Of(event), message.mutable_event());
  return message;
}

}  // namespace collision::server
