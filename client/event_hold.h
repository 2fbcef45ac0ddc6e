// Events that wait for the names of their agents.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// Samples of different topics may overtake each other, so an event can come before the
/// descriptions of its agents. Whoever prints names lets it wait here. The order stays: an event
/// also waits for those before it.
class EventHold {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// Longer a name is not waited for.
  static constexpr std::chrono::seconds kLongest{1};

  void Add(const v1::CollisionEvent& event, Wall now) { waiting_.emplace_back(event, now); }

  /// The events, first come first, up to the first one that still waits for a name.
  std::vector<v1::CollisionEvent> Take(const std::function<bool(const v1::AgentId&)>& is_named,
                                       Wall now);

 private:
  std::deque<std::pair<v1::CollisionEvent, Wall>> waiting_;  ///< With when they came.
};

}  // namespace collision::client
