#include "collision_core/broad_phase/index/row_store.h"

#include "collision_core/base/check.h"

namespace collision::broad_phase {

void RowStore::PlaceAll(const PlacedScene& /*scene*/, std::vector<PlacedBall>* horns) {
  row_.Clear();
  for (const PlacedBall& horn : *horns) Place(horn);
}

void RowStore::Place(const PlacedBall& horn) { row_.Set(horn.agent, horn); }

void RowStore::Unplace(std::uint32_t agent) {
  if (agent < row_.size()) row_.Vacate(agent);
}

bool RowStore::Join(const PlacedScene& scene, TimeWindow window, SearchCost* cost, PairSink* sink) {
  row_.Join(*scene.frame, window, &cost->work, sink);
  return true;
}

void RowStore::FindNear(const PlacedScene& scene, const PlacedBall& horn, TimeWindow window,
                        SearchCost* cost, std::vector<std::uint32_t>* near) {
  const std::size_t before = near->size();
  row_.FindNear(horn, *scene.frame, window, &cost->work, near);
  if (window.first > scene.frame->window()) cost->wasted += near->size() - before;
}

void RowStore::Validate() const {
  row_.Validate();
  for (std::uint32_t k = 0; k < row_.size(); ++k) {
    CORE_CHECK(row_.agent(k) == k || row_.agent(k) == PlacedBalls::kNoAgent,
               "an agent stands at its own index of the row", k, row_.agent(k));
  }
}

}  // namespace collision::broad_phase
