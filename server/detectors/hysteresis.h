// Which crossings of a level are told again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "collision_core/base/recent_map.h"
#include "collision_core/detection/events/collision_event.h"

namespace collision::server {

/// Two agents that hover about a margin cross it again and again. Between two crossings that are
/// told they have been farther apart than margin + hysteresis, for certain.
///
/// That they have been is known from a second detector, whose margin is that sum: where a contact
/// or a doubt of it ends in certified freedom. A crossing is told if
///  - none of its pair was told before, or it began before the pair was known, or
///  - the pair was that far apart after the begin of the one told last and not after its own begin.
/// Another one is held back, all its revisions and forecasts, and told as soon as it turns out that
/// the pair was that far apart: the two detectors evaluate a pair at different steps.
///
/// Depends on nothing but the calls. O(log pairs) for each event. One thread.
class Hysteresis {
 public:
  /// Pairs that are remembered; beyond twice as many those heard of longest ago are forgotten, and
  /// their next crossing is told as if it were their first.
  static constexpr std::size_t kPairsMax = 32768;

  /// Times of one pair that are remembered; beyond, the newest replaces the one before it.
  static constexpr std::size_t kTimesMax = 8;

  /// What to tell of one step: of the events `near` of the level those that are told, in their
  /// order, then those that had been held back. `far`: the events of the second detector.
  std::vector<detection::CollisionEvent> Take(const std::vector<detection::CollisionEvent>& near,
                                              const std::vector<detection::CollisionEvent>& far);

  /// Revisions that were held back and not told later.
  std::uint64_t withheld() const { return withheld_; }

 private:
  using Event = detection::CollisionEvent;

  struct Pair {
    std::uint32_t told = 0;      ///< Number of the crossing that was told last.
    Instant begin;               ///< By then it had begun.
    std::vector<Instant> apart;  ///< When they were far apart since, in the order of time.
    std::optional<Event> held;   ///< The newest revision that was held back.
  };

  static bool IsTold(const Event& event, const Pair& pair);
  void Note(const Event& event);
  void Hold(const Event& event, Pair* pair);

  RecentMap<std::pair<detection::AgentId, detection::AgentId>, Pair> pairs_{kPairsMax};
  std::uint64_t withheld_ = 0;
};

}  // namespace collision::server
