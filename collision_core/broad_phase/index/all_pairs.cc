#include "collision_core/broad_phase/index/all_pairs.h"

#include <utility>

#include "collision_core/base/check.h"
#include "collision_core/broad_phase/filter/filter_row.h"

namespace collision::broad_phase {
namespace {

/// Placed agents in one row, by index: the plainest store.
class RowStore : public PlacedStore {
 public:
  void PlaceAll(const PlacedScene& /*scene*/, std::vector<PlacedBall>* horns) override {
    row_.Clear();
    for (const PlacedBall& horn : *horns) Place(horn);
  }

  void Place(const PlacedBall& horn) override { row_.Set(horn.agent, horn); }

  void Unplace(std::uint32_t agent) override {
    if (agent < row_.size()) row_.Vacate(agent);
  }

  bool Join(const PlacedScene& scene, TimeWindow window, SearchCost* cost,
            PairSink* sink) override {
    row_.Join(*scene.frame, window, &cost->work, sink);
    return true;
  }

  void FindNear(const PlacedScene& scene, const PlacedBall& horn, TimeWindow window,
                SearchCost* cost, std::vector<std::uint32_t>* near) override {
    const std::size_t before = near->size();
    row_.FindNear(horn, *scene.frame, window, &cost->work, near);
    if (window.first > scene.frame->window()) cost->wasted += near->size() - before;
  }

  bool Holds(std::uint32_t agent) const override {
    return agent < row_.size() && row_.agent(agent) == agent;
  }

  void Validate() const override {
    row_.Validate();
    for (std::uint32_t k = 0; k < row_.size(); ++k) {
      CORE_CHECK(row_.agent(k) == k || row_.agent(k) == PlacedBalls::kNoAgent,
                 "an agent stands at its own index of the row", k, row_.agent(k));
    }
  }

 private:
  FilterRow row_;  ///< By agent.
};

}  // namespace

AllPairs::AllPairs(SharedRules rules)
    : AgentBounds(std::move(rules)), WindowedSearch(std::make_unique<RowStore>()) {}

}  // namespace collision::broad_phase
