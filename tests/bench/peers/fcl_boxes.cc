// FCL: the dynamic tree of boxes, built from all objects at once. The objects are made once; only
// their boxes change.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include "tests/bench/broad_phase/peers.h"

namespace collision::bench {
namespace {

class Fcl : public BoxPairs {
 public:
  void Find(const baselines::BallScene& scene, double window, PairSink* sink) override {
    if (objects_.size() != scene.size()) Make(scene.size());
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const auto box = baselines::SweptBoxOf(scene[i], window);
      // In the object's frame, which is the world's: the object's own box becomes just this.
      geometries_[i]->aabb_local =
          fcl::AABBd(fcl::Vector3d(box.lower[0], box.lower[1], box.lower[2]),
                     fcl::Vector3d(box.upper[0], box.upper[1], box.upper[2]));
      objects_[i]->computeAABB();
    }
    fcl::DynamicAABBTreeCollisionManagerd manager;
    manager.registerObjects(pointers_);
    manager.setup();
    manager.collide(sink, &Fcl::Collide);
  }

 private:
  void Make(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      geometries_.push_back(std::make_shared<fcl::Sphered>(1));
      objects_.push_back(std::make_unique<fcl::CollisionObjectd>(geometries_.back()));
      objects_.back()->setUserData(reinterpret_cast<void*>(i));
      pointers_.push_back(objects_.back().get());
    }
  }

  static bool Collide(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* sink) {
    const auto index = [](const fcl::CollisionObjectd* object) {
      return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
    };
    static_cast<PairSink*>(sink)->Offer(index(a), index(b));
    return false;  // Go on.
  }

  std::vector<std::shared_ptr<fcl::Sphered>> geometries_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  std::vector<fcl::CollisionObjectd*> pointers_;
};

}  // namespace

std::unique_ptr<BoxPairs> MakeFcl() { return std::make_unique<Fcl>(); }

}  // namespace collision::bench
