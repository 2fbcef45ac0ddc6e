#include "collision_core/broad_phase/index/all_pairs.h"

namespace collision::broad_phase {

void AllPairs::PlaceAll() {
  row_.Clear();
  for (const PlacedHorn& horn : horns_) PlaceOne(horn);
}

void AllPairs::PlaceOne(const PlacedHorn& horn) { row_.Set(horn.agent, horn); }

void AllPairs::Unplace(std::uint32_t agent) {
  if (agent < row_.size()) row_.Vacate(agent);
}

void AllPairs::Join(TimeWindow stretch, PairSink* sink) {
  row_.Join(placing_, stretch, &work_, sink);
}

void AllPairs::FindNear(const PlacedHorn& horn, TimeWindow stretch) {
  const std::size_t before = near_.size();
  row_.FindNear(horn, placing_, stretch, &work_, &near_);
  if (stretch.first > placing_.window()) wasted_ += near_.size() - before;
}

}  // namespace collision::broad_phase
