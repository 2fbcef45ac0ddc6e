// The pairs of a world that touch or may touch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "client/programs/shared/forecast_slots.h"
#include "client/programs/shared/world_view.h"

namespace collision::client {

/// Keeps the newest revision of each event that is possible or confirmed, but for those of levels.
/// One thread.
class OpenEvents {
 public:
  /// Four times as many pairs as a service tracks by default; beyond it no further one is kept.
  static constexpr std::size_t kEventsMax = 262144;

  /// Revisions in the order of their publication, as WorldView::TakeEvents() gives them.
  void Add(const std::vector<v1::CollisionEvent>& revisions);

  /// The `count` nearest in time: first what is expected (IsExpected()), the nearest first; of
  /// equally near ones those that touch come before those that may. They belong to this object.
  std::vector<const v1::CollisionEvent*> Nearest(const WorldView& view, std::size_t count) const;

  std::size_t possible() const { return events_.size() - confirmed(); }
  std::size_t confirmed() const;

 private:
  std::map<EventKey, v1::CollisionEvent> events_;
  ForecastSlots slots_;
};

}  // namespace collision::client
