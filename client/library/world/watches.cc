#include "client/library/world/watches.h"

#include <algorithm>

#include "idl/limits.h"

namespace collision::client {
namespace {

bool Names(const v1::Watch& watch, const AgentId& id) {
  return watch.all() ||
         std::any_of(watch.agents().begin(), watch.agents().end(), [&id](const v1::AgentId& agent) {
           return agent.simulator_id() == id.simulator && agent.slot() == id.slot &&
                  agent.generation() == id.generation;
         });
}

}  // namespace

void Watches::Hear(const v1::Watch& watch, Time now) {
  const bool is_heeded = watch.period_ns() >= wire::kWatchPeriodMin &&
                         watch.period_ns() <= wire::kWatchPeriodMax && watch.lease_ns() > 0 &&
                         watch.lease_ns() <= wire::kWatchLeaseMax;
  if (!is_heeded) {
    watches_.erase(watch.watcher_id());
    return;
  }
  if (watches_.size() >= wire::kWatchersMax && !watches_.contains(watch.watcher_id())) {
    watches_.erase(std::min_element(
        watches_.begin(), watches_.end(),
        [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; }));
  }
  watches_[watch.watcher_id()] = {watch, now, now + std::chrono::nanoseconds(watch.lease_ns())};
}

void Watches::Expire(Time now) {
  std::erase_if(watches_, [now](const auto& one) { return one.second.until <= now; });
}

std::optional<std::chrono::nanoseconds> Watches::PeriodOf(const AgentId& id) const {
  std::optional<std::chrono::nanoseconds> least;
  for (const auto& [watcher, standing] : watches_) {
    const std::chrono::nanoseconds period(standing.watch.period_ns());
    if (Names(standing.watch, id) && (!least || period < *least)) least = period;
  }
  return least;
}

}  // namespace collision::client
