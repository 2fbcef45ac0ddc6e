// Embree: a scene of user geometry whose bounds are the swept boxes, committed anew for each
// query, and rtcCollide() of the scene with itself.
#include <embree3/rtcore.h>

#include <stdexcept>
#include <vector>

#include "tests/bench/broad_phase/peers.h"
#include "tests/bench/peers/float_box.h"

namespace collision::bench {
namespace {

class Embree : public BoxPairs {
 public:
  Embree() : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    // The quality and flag that are fastest in total when every box is new: Morton codes.
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
  }

  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void Find(const baselines::BallScene& scene, double window, PairSink* sink) override {
    sink_ = sink;
    // The bounds function is called three times for each box: it only copies.
    boxes_.resize(scene.size());
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const auto box = baselines::SweptBoxOf(scene[i], window);
      boxes_[i] = {
          RoundedDown(box.lower[0]), RoundedDown(box.lower[1]), RoundedDown(box.lower[2]), 0,
          RoundedUp(box.upper[0]),   RoundedUp(box.upper[1]),   RoundedUp(box.upper[2]),   0};
    }
    if (geometry_ == nullptr) Attach();
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(scene.size()));
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
    rtcCollide(scene_, scene_, &Embree::Collide, this);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree failed");
  }

 private:
  void Attach() {
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    // Without it leaves hold several boxes, and rtcCollide() reports all pairs of two leaves.
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, &Embree::Bounds, nullptr);
    // rtcCollide() takes no geometry without both, though it never calls them.
    rtcSetGeometryIntersectFunction(geometry_, [](const RTCIntersectFunctionNArguments*) {});
    rtcSetGeometryOccludedFunction(geometry_, [](const RTCOccludedFunctionNArguments*) {});
    rtcAttachGeometry(scene_, geometry_);
    rtcReleaseGeometry(geometry_);  // The scene holds it.
  }

  static void Bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto* self = static_cast<const Embree*>(arguments->geometryUserPtr);
    *arguments->bounds_o = self->boxes_[arguments->primID];
  }

  static void Collide(void* user, RTCCollision* collisions, unsigned count) {
    PairSink* sink = static_cast<Embree*>(user)->sink_;
    for (unsigned i = 0; i < count; ++i) {
      // A pair comes in both orders, and each agent with itself.
      if (collisions[i].primID0 >= collisions[i].primID1) continue;
      sink->Offer(collisions[i].primID0, collisions[i].primID1);
    }
  }

  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
  std::vector<RTCBounds> boxes_;
  PairSink* sink_ = nullptr;
};

}  // namespace

std::unique_ptr<BoxPairs> MakeEmbree() { return std::make_unique<Embree>(); }

}  // namespace collision::bench
