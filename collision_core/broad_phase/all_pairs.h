// The plainest method: look at every pair.
#pragma once

#include "collision_core/broad_phase/lane_row.h"
#include "collision_core/broad_phase/near_search.h"

namespace collision {

/// Every agent beside every other, in wide vectors: below about a thousand agents the fastest.
class AllPairs : public NearSearch {
 protected:
  void PlaceAll() override;
  void PlaceOne(const PlacedHorn& horn) override;
  void Unplace(std::uint32_t agent) override;
  void Join(Stretch stretch, PairSink* sink) override;
  void FindNear(const PlacedHorn& horn, Stretch stretch) override;

 private:
  LaneRow row_;  ///< By agent.
};

}  // namespace collision
