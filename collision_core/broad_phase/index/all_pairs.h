// The plainest method: compare every pair.
#pragma once

#include "collision_core/broad_phase/index/filter_row.h"
#include "collision_core/broad_phase/index/windowed_search.h"

namespace collision::broad_phase {

/// Compares every agent with every other, in wide vectors: all agents in one row of lanes. The
/// fastest method for small scenes, and the reference for the others.
class AllPairs : public WindowedSearch {
 protected:
  void PlaceAll() override;
  void PlaceOne(const PlacedHorn& horn) override;
  void Unplace(std::uint32_t agent) override;
  void Join(TimeWindow stretch, PairSink* sink) override;
  void FindNear(const PlacedHorn& horn, TimeWindow stretch) override;

 private:
  FilterRow row_;  ///< By agent.
};

}  // namespace collision::broad_phase
