// What a scene needs, and what it can do without.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "collision_core/detection/agents/history.h"

namespace collision::detection {

/// Counts which parts of the mathematics the scene uses, by the agents' declarations and states,
/// never by measured time, so that the same scene gives the same profile everywhere. O(1) per
/// change.
class SceneProfile {
 public:
  /// One bit for each part that an agent needs.
  using Features = std::uint16_t;

  static Features Of(const History::Sample& newest);

  void Add(Features features) { Count(features, 1); }
  void Remove(Features features) { Count(features, -1); }

  /// Whether both count the same.
  friend bool operator==(const SceneProfile&, const SceneProfile&) = default;

  /// A line for each part that is left out, with the reason.
  std::vector<std::string> LeftOut() const;

 private:
  static constexpr int kFeatures = 13;

  void Count(Features features, int change);

  std::array<std::int64_t, kFeatures> counts_{};
};

}  // namespace collision::detection
