// Bullet: its dynamic tree of boxes, filled leaf by leaf, and collided with itself.
#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include "tests/bench/broad_phase/peers.h"
#include "tests/bench/peers/bullet_box.h"

namespace collision::bench {
namespace {

class Bullet : public BoxPairs, private btDbvt::ICollide {
 public:
  void Find(const baselines::BallScene& scene, double window, PairSink* sink) override {
    btDbvt tree;
    for (std::size_t i = 0; i < scene.size(); ++i) {
      tree.insert(BulletBox(baselines::SweptBoxOf(scene[i], window)), reinterpret_cast<void*>(i));
    }
    sink_ = sink;
    tree.collideTT(tree.m_root, tree.m_root, *this);
  }

 private:
  void Process(const btDbvtNode* a, const btDbvtNode* b) override {
    sink_->Offer(AgentOf(a), AgentOf(b));
  }

  PairSink* sink_ = nullptr;
};

}  // namespace

std::unique_ptr<BoxPairs> MakeBullet() { return std::make_unique<Bullet>(); }

}  // namespace collision::bench
