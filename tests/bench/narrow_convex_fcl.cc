// FCL's convex shapes, by both of its solvers and what it has for pairs of one kind.
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "tests/bench/narrow_convex.h"
#include "tests/bench/narrow_fcl_shapes.h"
#include "tests/bench/narrow_fcl_types.h"

namespace collision::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// What its solver for distances stops at [m]; more exact than the answer has to be.
constexpr double kTolerance = 1e-8;

void Add(const std::string& name, const Geometry& a, const Geometry& b, fcl::GJKSolverType solver,
         NarrowQueries* queries) {
  fcl::CollisionRequestd collision(1, false);
  collision.gjk_solver_type = solver;
  const auto decide = [a, b, collision](const PlainPose& at) {
    fcl::CollisionResultd result;
    return Plain(fcl::collide(a.get(), fcl::Transform3d::Identity(), b.get(), FclPose(at),
                              collision, result) > 0);
  };
  const fcl::DistanceRequestd distance(false, false, 0, 0, kTolerance, solver);
  const auto measure = [a, b, distance](const PlainPose& at) {
    fcl::DistanceResultd result;
    fcl::distance(a.get(), fcl::Transform3d::Identity(), b.get(), FclPose(at), distance, result);
    return Plain(result.min_distance);
  };
  queries->push_back({name, Task::kDecision, Who::kLibrary, decide});
  queries->push_back({name, Task::kDistance, Who::kLibrary, measure});
}

}  // namespace

NarrowQueries FclConvexQueries(const PlainConvex& plain_a, const PlainConvex& plain_b) {
  const Geometry a = FclGeometry(plain_a), b = FclGeometry(plain_b);
  NarrowQueries queries;
  Add("FCL libccd", a, b, fcl::GST_LIBCCD, &queries);
  Add("FCL own solver", a, b, fcl::GST_INDEP, &queries);
  return queries;
}

}  // namespace collision::bench
