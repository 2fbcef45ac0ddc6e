// The method for large and changing scenes: grids by reach.
#pragma once

#include <memory>
#include <utility>

#include "collision_core/broad_phase/index/grid_store.h"
#include "collision_core/broad_phase/index/windowed_search.h"

namespace collision::broad_phase {

/// Searches grids of agents of like reach (grid_store.h).
class SpatialIndex : public WindowedSearch {
 public:
  explicit SpatialIndex(SharedRules rules = NoRules())
      : AgentBounds(std::move(rules)), WindowedSearch(std::make_unique<GridStore>()) {}
};

}  // namespace collision::broad_phase
