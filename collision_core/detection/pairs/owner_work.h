// What the narrow phase has done for one owner.
#pragma once

#include <cstdint>

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"

namespace collision::detection {

/// What the narrow phase has done for the pairs that one owner pays for, since it has had any.
struct OwnerWork {
  OwnerId owner;
  std::uint64_t wanted = 0;     ///< Evaluations that its pairs have asked for.
  std::uint64_t evaluated = 0;  ///< Evaluations that were made.
  std::uint64_t work_units = 0;
  std::uint32_t waiting = 0;  ///< Pairs that no step has had work for yet.
  /// Some of its pairs have waited in every step from this time on; Never(): none waits now.
  Instant held_since = Instant::Never();
  std::uint32_t sharing = 1;  ///< Owners among which the last step was shared, if it was held.
};

}  // namespace collision::detection
