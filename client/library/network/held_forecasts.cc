#include "client/library/network/held_forecasts.h"

#include <utility>

#include "client/library/network/conversion.h"

namespace collision::client {

void HeldForecasts::Hold(const v1::CollisionEvent& event) {
  v1::CollisionEvent& held =
      by_pair_[{FromMessage(event.lower()), FromMessage(event.higher()), event.level()}];
  if (event.stamp().sequence() > held.stamp().sequence()) held = event;
}

std::vector<v1::CollisionEvent> HeldForecasts::Take() {
  std::vector<v1::CollisionEvent> taken;
  taken.reserve(by_pair_.size());
  for (auto& [pair, event] : by_pair_) taken.push_back(std::move(event));
  by_pair_.clear();
  std::sort(taken.begin(), taken.end(), [](const auto& a, const auto& b) {
    return a.stamp().sequence() < b.stamp().sequence();
  });
  return taken;
}

}  // namespace collision::client
