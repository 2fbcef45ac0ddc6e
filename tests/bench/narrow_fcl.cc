// FCL: two trees of one mesh, asked with each kind of bounding volume that serves the question.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <limits>

#include "tests/bench/measure.h"
#include "tests/bench/narrow_fcl_types.h"
#include "tests/bench/narrow_query.h"

namespace collision::bench {
namespace {

template <typename Volume>
NarrowQuery Decision(const std::string& name, std::shared_ptr<fcl::BVHModel<Volume>> model) {
  const auto ask = [model,
                    result = std::make_shared<fcl::CollisionResultd>()](const PlainPose& at) {
    static const fcl::CollisionRequestd request(1, false);
    result->clear();
    return Plain(fcl::collide(model.get(), fcl::Transform3d::Identity(), model.get(), FclPose(at),
                              request, *result) > 0);
  };
  return {name, Task::kDecision, Who::kLibrary, ask};
}

template <typename Volume>
NarrowQuery Distance(const std::string& name, std::shared_ptr<fcl::BVHModel<Volume>> model) {
  const auto ask = [model](const PlainPose& at) {
    static const fcl::DistanceRequestd request(false, false);
    fcl::DistanceResultd result;
    fcl::distance(model.get(), fcl::Transform3d::Identity(), model.get(), FclPose(at), request,
                  result);
    return Plain(result.min_distance);
  };
  return {name, Task::kDistance, Who::kLibrary, ask};
}

}  // namespace

NarrowQueries FclQueries(const PlainMesh& mesh) {
  const auto obb = FclModel<fcl::OBBd>(mesh);
  const auto rss = FclModel<fcl::RSSd>(mesh);
  const auto both = FclModel<fcl::OBBRSSd>(mesh);
  return {Decision("FCL OBB", obb), Decision("FCL OBBRSS", both), Distance("FCL RSS", rss),
          Distance("FCL OBBRSS", both)};
}

double FclBuildTime(const PlainMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const CpuStopwatch watch;
    FclModel<fcl::OBBRSSd>(mesh);
    least = std::min(least, watch.seconds());
  }
  return least;
}

}  // namespace collision::bench
