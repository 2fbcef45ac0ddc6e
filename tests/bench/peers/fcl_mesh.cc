// FCL: two trees of one mesh, asked with each kind of bounding volume that serves the query.
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "tests/bench/harness/measure.h"
#include "tests/bench/pairs/peers.h"
#include "tests/bench/peers/fcl_types.h"

namespace collision::bench {
namespace {

/// Version 0.7 uses the errors allowed before it knows the request: both points show it.
constexpr double kShares[] = {0.5, 0};
/// Beyond any distance here [m].
constexpr double kFar = 100;

template <typename Volume>
using Model = std::shared_ptr<fcl::BVHModel<Volume>>;

template <typename Volume>
PairMethod Decision(const std::string& name, const Model<Volume>& model) {
  const auto ask = [model,
                    result = std::make_shared<fcl::CollisionResultd>()](const PlainPose& at) {
    static const fcl::CollisionRequestd request(1, false);
    result->clear();
    return Plain(fcl::collide(model.get(), fcl::Transform3d::Identity(), model.get(), FclPose(at),
                              request, *result) > 0);
  };
  return {.name = name,
          .task = Task::kDecision,
          .limited_by = "plain doubles, without a bound of their error",
          .ask = ask};
}

/// `share`: the relative error allowed.
template <typename Volume>
PairMethod Distance(const std::string& name, const Model<Volume>& model, double share = 0) {
  // Its search stops where both errors allow it: the absolute one always does.
  const fcl::DistanceRequestd request(false, false, share, share > 0 ? kFar : 0);
  const auto ask = [model, request](const PlainPose& at) {
    fcl::DistanceResultd result;
    fcl::distance(model.get(), fcl::Transform3d::Identity(), model.get(), FclPose(at), request,
                  result);
    return Plain(result.min_distance);
  };
  return {.name = name,
          .task = Task::kDistance,
          .limited_by = "plain doubles without a bound; the errors allowed do not count for meshes",
          .ask = ask};
}

template <typename Volume>
void AddDistances(const std::string& name, const PlainMesh& mesh, PairMethods* methods) {
  const auto model = FclModel<Volume>(mesh);
  for (const double share : kShares) {
    methods->push_back(Distance(name, model, share));
    methods->back().setting = SettingText("relative error", share, "");
  }
}

}  // namespace

PairMethods FclMesh(const PlainMesh& mesh) {
  const auto obb = FclModel<fcl::OBBd>(mesh);
  const auto rss = FclModel<fcl::RSSd>(mesh);
  const auto both = FclModel<fcl::OBBRSSd>(mesh);
  return {Decision("FCL OBB", obb), Decision("FCL OBBRSS", both), Distance("FCL RSS", rss),
          Distance("FCL OBBRSS", both)};
}

PairMethods FclMeshCurves(const PlainMesh& mesh) {
  PairMethods methods;
  AddDistances<fcl::RSSd>("FCL RSS distance", mesh, &methods);
  AddDistances<fcl::OBBRSSd>("FCL OBBRSS distance", mesh, &methods);
  return methods;
}

double FclBuildTime(const PlainMesh& mesh) {
  return LeastCpuSeconds(3, [&mesh] { FclModel<fcl::OBBRSSd>(mesh); });
}

}  // namespace collision::bench
