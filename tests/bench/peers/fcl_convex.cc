// FCL's convex shapes, by both of its solvers and its own routines for pairs of one kind.
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "tests/bench/pairs/peers.h"
#include "tests/bench/peers/fcl_types.h"

namespace collision::bench {
namespace {

constexpr double kTolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
/// In the contest: FCL's default for decisions, and more exact than asked for distances [m].
constexpr double kDecisionTolerance = 1e-6, kDistanceTolerance = 1e-8;

struct Pair {
  FclGeometry a, b;
  fcl::GJKSolverType solver;
};

PairMethod Named(const std::string& name, Task task) {
  return {
      .name = name, .task = task, .limited_by = "the tolerance of its search, then plain doubles"};
}

PairMethod Decision(const std::string& name, const Pair& pair, double tolerance) {
  PairMethod method = Named(name, Task::kDecision);
  fcl::CollisionRequestd request(1, false);
  request.gjk_solver_type = pair.solver;
  request.gjk_tolerance = tolerance;
  method.ask = [pair, request](const PlainPose& at) {
    fcl::CollisionResultd result;
    return Plain(fcl::collide(pair.a.get(), fcl::Transform3d::Identity(), pair.b.get(), FclPose(at),
                              request, result) > 0);
  };
  return method;
}

PairMethod Distance(const std::string& name, const Pair& pair, double tolerance) {
  PairMethod method = Named(name, Task::kDistance);
  const fcl::DistanceRequestd request(false, false, 0, 0, tolerance, pair.solver);
  method.ask = [pair, request](const PlainPose& at) {
    fcl::DistanceResultd result;
    fcl::distance(pair.a.get(), fcl::Transform3d::Identity(), pair.b.get(), FclPose(at), request,
                  result);
    return Plain(result.min_distance);
  };
  return method;
}

struct Solver {
  const char* name;
  fcl::GJKSolverType type;
};
constexpr Solver kSolvers[] = {{"FCL libccd", fcl::GST_LIBCCD}, {"FCL own solver", fcl::GST_INDEP}};

}  // namespace

PairMethods FclConvex(const PlainConvex& a, const PlainConvex& b) {
  PairMethods methods;
  const FclGeometry of_a = FclSolid(a), of_b = FclSolid(b);
  for (const Solver& solver : kSolvers) {
    const Pair pair{of_a, of_b, solver.type};
    methods.push_back(Decision(solver.name, pair, kDecisionTolerance));
    methods.push_back(Distance(solver.name, pair, kDistanceTolerance));
  }
  return methods;
}

PairMethods FclConvexCurves(const PlainConvex& a, const PlainConvex& b) {
  PairMethods methods;
  const FclGeometry of_a = FclSolid(a), of_b = FclSolid(b);
  for (const Solver& solver : kSolvers) {
    const Pair pair{of_a, of_b, solver.type};
    const std::string name = solver.name;
    for (const double tolerance : kTolerances) {
      methods.push_back(Distance(name + " distance", pair, tolerance));
      methods.push_back(Decision(name + " yes or no", pair, tolerance));
      for (PairMethod* method : {&methods.back() - 1, &methods.back()}) {
        method->setting = SettingText("tolerance", tolerance, "");
      }
    }
  }
  return methods;
}

}  // namespace collision::bench
