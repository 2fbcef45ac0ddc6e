#include "client/library/network/held_forecasts.h"

#include <utility>

namespace collision::client {

std::vector<v1::CollisionEvent> HeldForecasts::Take() {
  std::vector<v1::CollisionEvent> taken;
  taken.reserve(by_slot_.size());
  for (auto& [slot, event] : by_slot_) taken.push_back(std::move(event));
  by_slot_.clear();
  std::sort(taken.begin(), taken.end(), [](const auto& a, const auto& b) {
    return a.stamp().sequence() < b.stamp().sequence();
  });
  return taken;
}

}  // namespace collision::client
