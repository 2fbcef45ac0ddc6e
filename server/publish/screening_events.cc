#include "server/publish/screening_events.h"

#include "server/codec/encode.h"
#include "server/codec/hypothetical.h"
#include "server/publish/because.h"
#include "server/publish/inherited_events.h"

namespace collision::server {
namespace {

/// Of a pair, the one that is hypothetical.
const detection::AgentId& HypotheticalOf(const detection::CollisionEvent& event) {
  return event.lower_side == kHypotheticalSide ? event.lower : event.higher;
}

/// A contact is told once, not a second time as the forecast that came true.
bool IsCopy(const Telling& telling) { return !telling.contact && IsContact(telling.event.status); }

bool IsOver(v1::EventStatus status) {
  return status != v1::EVENT_POSSIBLE && status != v1::EVENT_CONFIRMED;
}

/// To the program that speaks for its simulator. False: the run that it is about is over.
bool Address(const World& world, v1::ScreeningEvent* message) {
  const auto owner = world.simulators().find(message->simulator_id());
  if (owner == world.simulators().end() || owner->second.run() != message->run()) return false;
  message->set_incarnation(owner->second.incarnation());
  return true;
}

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

void ScreeningEvents::Keep(std::vector<v1::ScreeningEvent> untold) {
  for (v1::ScreeningEvent& message : untold) {
    const std::pair pair(IdOf(message.event().lower()), IdOf(message.event().higher()));
    untold_.Touch(pair) = std::move(message);
  }
}

std::vector<v1::ScreeningEvent> ScreeningEvents::TakeInherited(const World& world) {
  std::vector<v1::ScreeningEvent> messages;
  untold_.ForEach([&](const auto&, v1::ScreeningEvent& last) {
    if (IsOver(last.event().status()) && Address(world, &last)) messages.push_back(last);
  });
  untold_.Clear();
  for (const Telling& telling : filter_.Standing()) {
    if (auto message = MessageOf(telling.event, world)) messages.push_back(std::move(*message));
  }
  return messages;
}

void ScreeningEvents::Forget() {
  untold_.Clear();
  filter_.Forget();
  labels_.Forget();
}

std::optional<v1::ScreeningEvent> ScreeningEvents::MessageOf(const detection::CollisionEvent& event,
                                                             const World& world) const {
  const detection::AgentId& agent = HypotheticalOf(event);
  v1::ScreeningEvent message;
  message.set_simulator_id(agent.simulator);
  message.set_pair_slot(event.pair_slot);
  message.set_run(agent.run);
  if (!Address(world, &message)) return std::nullopt;
  *message.mutable_event() = Encode(event);
  AddBecause(world, message.mutable_event());
  AddLabels(labels_.Of(event), message.mutable_event());
  return message;
}

}  // namespace collision::server
