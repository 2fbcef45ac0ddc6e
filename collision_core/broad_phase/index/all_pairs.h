// The plainest method: compare every pair.
#pragma once

#include "collision_core/broad_phase/index/windowed_search.h"

namespace collision::broad_phase {

/// Compares every agent with every other, in wide vectors: O(1) to change an agent, O(N) for a
/// query about one, O(N²) about all. The fastest method for small scenes.
class AllPairs : public WindowedSearch {
 public:
  explicit AllPairs(SharedRules rules = NoRules());
};

}  // namespace collision::broad_phase
