// Events that wait for the names of their agents.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "collision/export.h"
#include "collision/types.h"

namespace collision::client {

/// Holds events until the names of both agents are known.
///
/// Samples of different topics may overtake each other, so an event can arrive before the
/// descriptions of its agents. A program that prints names keeps its events here meanwhile. The
/// order stays: an event also waits for those before it.
class COLLISION_API PendingNames {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// Maximum time to wait for a name.
  static constexpr std::chrono::seconds kWaitMax{1};

  void Add(const Event& event, Wall now) { waiting_.emplace_back(event, now); }

  /// Removes and returns the events up to the first that still waits for a name, oldest first.
  std::vector<Event> Take(const std::function<bool(const AgentId&)>& is_named, Wall now);

 private:
  std::deque<std::pair<Event, Wall>> waiting_;  ///< With the time of arrival.
};

}  // namespace collision::client
