// What a scene needs, and what it can do without.
#pragma once

#include <string>
#include <vector>

#include "collision_core/detection/agent_record.h"

namespace collision {

/// Counts, agent by agent, which parts of the mathematics the scene uses. Chosen by counted
/// features, never by measured time, so that the same scene gives the same choice everywhere.
class SceneProfile {
 public:
  void Count(const AgentRecord& agent);

  /// The method, why, and a line for each part that is left out, with the reason.
  Detector::Profile Describe() const;

 private:
  std::size_t agents_ = 0;
  std::size_t accelerating_ = 0;
  std::size_t directed_ = 0;
  std::size_t stepping_ = 0;
  std::size_t uncertain_ = 0;
  std::size_t expiring_ = 0;
  std::size_t masked_ = 0;
  std::size_t shaped_ = 0;
  std::size_t turning_ = 0;
  bool skewed_ = false;
};

}  // namespace collision
