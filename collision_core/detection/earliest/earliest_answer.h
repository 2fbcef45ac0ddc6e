// The earliest possible intersection of a whole scene.
#pragma once

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"

namespace collision::detection {

/// The earliest possible intersection over all pairs of agents that are not in contact; of equal
/// ones that of the lowest ids. Where the search was cut short (Detector::Earliest()), a certified
/// lower bound of it.
struct EarliestAnswer {
  bool found = false;
  Instant earliest = Instant::Never();
  AgentId lower;  ///< Equal to `higher` where one agent is known, but not its partner: saturated,
                  ///< or cut short.
  AgentId higher;
};

}  // namespace collision::detection
