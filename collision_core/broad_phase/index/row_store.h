// Placed agents in one row: the plainest store.
#pragma once

#include <vector>

#include "collision_core/broad_phase/index/filter_row.h"
#include "collision_core/broad_phase/index/placed_store.h"

namespace collision::broad_phase {

/// Compares an agent with all others, in wide vectors. O(1) to change, O(N) a search, O(N²) a join.
class RowStore : public PlacedStore {
 public:
  void PlaceAll(const PlacedScene& scene, std::vector<PlacedBall>* horns) override;
  void Place(const PlacedBall& horn) override;
  void Unplace(std::uint32_t agent) override;
  bool Join(const PlacedScene& scene, TimeWindow window, SearchCost* cost, PairSink* sink) override;
  void FindNear(const PlacedScene& scene, const PlacedBall& horn, TimeWindow window,
                SearchCost* cost, std::vector<std::uint32_t>* near) override;
  void Validate() const override;

 private:
  FilterRow row_;  ///< By agent.
};

}  // namespace collision::broad_phase
