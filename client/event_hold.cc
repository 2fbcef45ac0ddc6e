#include "client/event_hold.h"

namespace collision::client {

std::vector<v1::CollisionEvent> EventHold::Take(
    const std::function<bool(const v1::AgentId&)>& is_named, Wall now) {
  std::vector<v1::CollisionEvent> events;
  while (!waiting_.empty()) {
    const auto& [event, came] = waiting_.front();
    const bool named = is_named(event.lower()) && is_named(event.higher());
    if (!named && now - came < kLongest) break;
    events.push_back(event);
    waiting_.pop_front();
  }
  return events;
}

}  // namespace collision::client
