#include "client/programs/tools/collisionctl/top/open_events.h"

#include <algorithm>

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"

namespace collision::client {
namespace {

bool IsOpen(const v1::CollisionEvent& event) {
  return event.status() == v1::EVENT_POSSIBLE || event.status() == v1::EVENT_CONFIRMED;
}

}  // namespace

void OpenEvents::Add(const std::vector<v1::CollisionEvent>& revisions) {
  for (const v1::CollisionEvent& event : revisions) {
    if (const auto ended = slots_.Take(event)) {
      const auto former = events_.find(*ended);
      const bool is_forecast =
          former != events_.end() && former->second.status() == v1::EVENT_POSSIBLE;
      if (is_forecast) events_.erase(former);
    }
    if (!event.level().empty()) continue;
    const EventKey key = KeyOf(event);
    if (!IsOpen(event)) {
      events_.erase(key);
    } else if (events_.size() < kEventsMax || events_.contains(key)) {
      events_[key] = event;
    }
  }
}

std::vector<const v1::CollisionEvent*> OpenEvents::Nearest(const WorldView& view,
                                                           std::size_t count) const {
  std::vector<std::tuple<bool, std::int64_t, bool, const v1::CollisionEvent*>> order;
  for (const auto& [key, event] : events_) {
    if (IsOfEarlierEpoch(event, view)) continue;
    const bool may = event.status() == v1::EVENT_POSSIBLE;
    order.emplace_back(!IsExpected(event), DistanceInTime(event, NowOf(event, view)), may, &event);
  }
  // The order of the keys, not of the addresses, decides the rest.
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    const auto key = [](const auto& one) {
      return std::tie(std::get<0>(one), std::get<1>(one), std::get<2>(one));
    };
    return key(a) < key(b);
  });
  std::vector<const v1::CollisionEvent*> nearest;
  for (const auto& one : order) {
    if (nearest.size() == count) break;
    nearest.push_back(std::get<3>(one));
  }
  return nearest;
}

std::size_t OpenEvents::confirmed() const {
  return static_cast<std::size_t>(std::count_if(
      events_.begin(), events_.end(),
      [](const auto& event) { return event.second.status() == v1::EVENT_CONFIRMED; }));
}

}  // namespace collision::client
