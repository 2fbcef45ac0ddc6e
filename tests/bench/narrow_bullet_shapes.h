// Convex solids as Bullet takes them, and their distance by its GJK and EPA.
#pragma once

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

/// `margin`: within a box, whose corners it makes round; around a hull; a capsule has its own [m].
inline std::shared_ptr<btConvexShape> BulletGeometry(const PlainConvex& convex, double margin) {
  const auto number = [](double x) { return static_cast<btScalar>(x); };
  const auto& [x, y, z] = convex.half;
  switch (convex.kind) {
    case PlainConvex::Kind::kCapsule:
      return std::make_shared<btCapsuleShapeZ>(number(convex.radius), number(2 * z));
    case PlainConvex::Kind::kBox: {
      auto box = std::make_shared<btBoxShape>(btVector3(number(x), number(y), number(z)));
      box->setMargin(number(margin));
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
  hull->setMargin(number(margin));
  return hull;
}

/// Below 0: that deep in each other.
inline double BulletDistance(const btConvexShape& a, const btConvexShape& b, const PlainPose& at) {
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

}  // namespace collision::bench
