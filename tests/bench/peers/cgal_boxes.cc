// CGAL: box_self_intersection_d, which streams and sweeps without a tree.
#include <CGAL/box_intersection_d.h>

#include "tests/bench/broad_phase/peers.h"

namespace collision::bench {
namespace {

class Cgal : public BoxPairs {
 public:
  void Find(const baselines::BallScene& scene, double window, PairSink* sink) override {
    boxes_.clear();
    boxes_.reserve(scene.size());
    for (const baselines::BallAgent& agent : scene) {
      auto box = baselines::SweptBoxOf(agent, window);
      boxes_.emplace_back(box.lower, box.upper, &agent);
    }
    const baselines::BallAgent* first = scene.data();
    CGAL::box_self_intersection_d(boxes_.begin(), boxes_.end(),
                                  [sink, first](const Box& a, const Box& b) {
                                    sink->Offer(static_cast<std::uint32_t>(a.handle() - first),
                                                static_cast<std::uint32_t>(b.handle() - first));
                                  });
  }

 private:
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const baselines::BallAgent*,
                                                          CGAL::Box_intersection_d::ID_FROM_HANDLE>;
  std::vector<Box> boxes_;
};

}  // namespace

std::unique_ptr<BoxPairs> MakeCgal() { return std::make_unique<Cgal>(); }

}  // namespace collision::bench
