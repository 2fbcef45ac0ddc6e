// The plainest method: compare every pair.
#pragma once

#include <memory>

#include "collision_core/broad_phase/index/row_store.h"
#include "collision_core/broad_phase/index/windowed_search.h"

namespace collision::broad_phase {

/// Compares every agent with every other, in wide vectors. The fastest method for small scenes.
class AllPairs : public WindowedSearch {
 public:
  AllPairs() : WindowedSearch(std::make_unique<RowStore>()) {}
};

}  // namespace collision::broad_phase
