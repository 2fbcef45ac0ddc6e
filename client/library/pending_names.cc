#include "collision/pending_names.h"

namespace collision::client {

std::vector<Event> PendingNames::Take(const std::function<bool(const AgentId&)>& is_named,
                                      Wall now) {
  std::vector<Event> events;
  while (!waiting_.empty()) {
    const auto& [event, arrived] = waiting_.front();
    const bool named = is_named(event.lower) && is_named(event.higher);
    if (!named && now - arrived < kWaitMax) break;
    events.push_back(event);
    waiting_.pop_front();
  }
  return events;
}

}  // namespace collision::client
