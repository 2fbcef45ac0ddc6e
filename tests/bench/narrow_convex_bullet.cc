// Bullet's convex shapes, by its GJK and EPA.
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <memory>

#include "tests/bench/narrow_bullet_types.h"
#include "tests/bench/narrow_convex.h"

namespace collision::bench {
namespace {

using Geometry = std::shared_ptr<btConvexShape>;

Geometry GeometryOf(const PlainConvex& convex) {
  const auto number = [](double x) { return static_cast<btScalar>(x); };
  const auto& [x, y, z] = convex.half;
  switch (convex.kind) {
    case PlainConvex::Kind::kCapsule:
      return std::make_shared<btCapsuleShapeZ>(number(convex.radius), number(2 * z));
    case PlainConvex::Kind::kBox: {
      auto box = std::make_shared<btBoxShape>(btVector3(number(x), number(y), number(z)));
      // Within its extents it would be a margin that makes corners round.
      box->setMargin(0);
      return box;
    }
    case PlainConvex::Kind::kHull:
      break;
  }
  auto hull = std::make_shared<btConvexHullShape>();
  for (const auto& p : convex.hull.vertices) {
    hull->addPoint(btVector3(number(p[0]), number(p[1]), number(p[2])), false);
  }
  hull->recalcLocalAabb();
  // Its margin would make it larger.
  hull->setMargin(0);
  return hull;
}

/// Below 0: that deep in each other.
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

}  // namespace

NarrowQueries BulletConvexQueries(const PlainConvex& plain_a, const PlainConvex& plain_b) {
  const Geometry a = GeometryOf(plain_a), b = GeometryOf(plain_b);
  const auto decide = [a, b](const PlainPose& at) { return Plain(DistanceOf(*a, *b, at) <= 0); };
  const auto measure = [a, b](const PlainPose& at) { return Plain(DistanceOf(*a, *b, at)); };
  return {{"Bullet GJK", Task::kDecision, Who::kLibrary, decide},
          {"Bullet GJK", Task::kDistance, Who::kLibrary, measure}};
}

}  // namespace collision::bench
