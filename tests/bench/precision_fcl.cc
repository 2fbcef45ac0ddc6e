// FCL over its tolerances: the distance of meshes and of convex shapes.
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "tests/bench/narrow_convex.h"
#include "tests/bench/narrow_fcl_shapes.h"
#include "tests/bench/narrow_fcl_types.h"
#include "tests/bench/precision_convex.h"

namespace collision::bench {
namespace {

/// Version 0.7 takes the errors allowed before it is told the request: both points show it.
constexpr double kShares[] = {0.5, 0};
/// Beyond any distance here [m].
constexpr double kFar = 100;
constexpr double kTolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};

template <typename Volume>
void AddDistances(const std::string& name, const PlainMesh& mesh, PrecisionMethods* methods) {
  const auto model = FclModel<Volume>(mesh);
  for (const double share : kShares) {
    PrecisionMethod method;
    method.name = name;
    method.setting = SettingText("relative error", share, "");
    method.limited_by = "plain doubles without a bound; the errors allowed do not count for meshes";
    method.ask = [model, share](const PlainPose& at) {
      // Its search stops where both errors allow it: the absolute one always does.
      const fcl::DistanceRequestd request(false, false, share, share > 0 ? kFar : 0);
      fcl::DistanceResultd result;
      fcl::distance(model.get(), fcl::Transform3d::Identity(), model.get(), FclPose(at), request,
                    result);
      return Plain(result.min_distance);
    };
    methods->push_back(std::move(method));
  }
}

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

void AddSolver(const std::string& name, const Geometry& a, const Geometry& b,
               fcl::GJKSolverType solver, PrecisionMethods* methods) {
  for (const double tolerance : kTolerances) {
    PrecisionMethod method;
    method.name = name + " distance";
    method.setting = SettingText("tolerance", tolerance, "");
    method.limited_by = "the tolerance of its search, then plain doubles";
    const fcl::DistanceRequestd distance(false, false, 0, 0, tolerance, solver);
    method.ask = [a, b, distance](const PlainPose& at) {
      fcl::DistanceResultd result;
      fcl::distance(a.get(), fcl::Transform3d::Identity(), b.get(), FclPose(at), distance, result);
      return Plain(result.min_distance);
    };
    methods->push_back(method);
    method.name = name + " yes or no";
    method.decides = true;
    fcl::CollisionRequestd collision(1, false);
    collision.gjk_solver_type = solver;
    collision.gjk_tolerance = tolerance;
    method.ask = [a, b, collision](const PlainPose& at) {
      fcl::CollisionResultd result;
      return Plain(fcl::collide(a.get(), fcl::Transform3d::Identity(), b.get(), FclPose(at),
                                collision, result) > 0);
    };
    methods->push_back(std::move(method));
  }
}

}  // namespace

PrecisionMethods FclMeshMethods(const PlainMesh& mesh) {
  PrecisionMethods methods;
  AddDistances<fcl::RSSd>("FCL RSS distance", mesh, &methods);
  AddDistances<fcl::OBBRSSd>("FCL OBBRSS distance", mesh, &methods);
  return methods;
}

PrecisionMethods FclConvexMethods(const PlainConvex& plain_a, const PlainConvex& plain_b) {
  const Geometry a = FclGeometry(plain_a), b = FclGeometry(plain_b);
  PrecisionMethods methods;
  AddSolver("FCL libccd", a, b, fcl::GST_LIBCCD, &methods);
  AddSolver("FCL own solver", a, b, fcl::GST_INDEP, &methods);
  return methods;
}

}  // namespace collision::bench
