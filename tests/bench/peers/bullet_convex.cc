// Bullet's convex shapes, by its GJK and EPA: without margins, and over them.
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "tests/bench/pairs/peers.h"
#include "tests/bench/peers/bullet_types.h"

namespace collision::bench {
namespace {

/// Below 0: the penetration depth.
double DistanceOf(const btConvexShape& a, const btConvexShape& b, const PlainPose& at) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btGjkPairDetector detector(&a, &b, &simplex, &depth);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = btTransform::getIdentity();
  input.m_transformB = BulletPose(at);
  btPointCollector result;
  detector.getClosestPoints(input, result, nullptr);
  return static_cast<double>(result.m_distance);
}

PairMethod Gjk(const PlainConvex& plain_a, const PlainConvex& plain_b, Task task, double margin) {
  PairMethod method{
      .name = "Bullet GJK", .task = task, .limited_by = "single precision; then the margin"};
  const auto a = BulletSolid(plain_a, margin), b = BulletSolid(plain_b, margin);
  method.ask = [a, b, task](const PlainPose& at) {
    const double distance = DistanceOf(*a, *b, at);
    return Plain(task == Task::kDecision ? distance <= 0 : distance);
  };
  return method;
}

}  // namespace

PairMethods BulletConvex(const PlainConvex& a, const PlainConvex& b) {
  return {Gjk(a, b, Task::kDecision, 0), Gjk(a, b, Task::kDistance, 0)};
}

PairMethods BulletConvexCurves(const PlainConvex& a, const PlainConvex& b) {
  PairMethods methods;
  for (const double margin : kBulletMargins) {
    methods.push_back(Gjk(a, b, Task::kDistance, margin));
    methods.back().setting = SettingText("margin", margin, "m");
  }
  return methods;
}

}  // namespace collision::bench
