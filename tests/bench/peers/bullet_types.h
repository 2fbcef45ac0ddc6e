// Poses, convex solids and moving bodies in Bullet's types.
#pragma once

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <LinearMath/btTransform.h>

#include <memory>

#include "tests/bench/pairs/contact_method.h"
#include "tests/bench/pairs/plain_convex.h"

namespace collision::bench {

inline btScalar BulletNumber(double x) { return static_cast<btScalar>(x); }

inline btVector3 BulletVector(const std::array<double, 3>& v) {
  return btVector3(BulletNumber(v[0]), BulletNumber(v[1]), BulletNumber(v[2]));
}

inline btTransform BulletPose(const PlainPose& at) {
  const auto& r = at.rotation;
  return btTransform(
      btMatrix3x3(BulletNumber(r[0][0]), BulletNumber(r[0][1]), BulletNumber(r[0][2]),
                  BulletNumber(r[1][0]), BulletNumber(r[1][1]), BulletNumber(r[1][2]),
                  BulletNumber(r[2][0]), BulletNumber(r[2][1]), BulletNumber(r[2][2])),
      BulletVector(at.offset));
}

inline btTransform BulletPose(const MovingBody& body) {
  const auto& [w, x, y, z] = body.q;
  return btTransform(
      btQuaternion(BulletNumber(x), BulletNumber(y), BulletNumber(z), BulletNumber(w)),
      BulletVector(body.p));
}

/// A ball or a box; null for a mesh.
inline std::shared_ptr<btConvexShape> BulletShape(const MovingBody& body) {
  switch (body.kind) {
    case MovingBody::Kind::kBall:
      return std::make_shared<btSphereShape>(BulletNumber(body.half[0]));
    case MovingBody::Kind::kBox:
      return std::make_shared<btBoxShape>(BulletVector(body.half));
    case MovingBody::Kind::kMesh:
      break;
  }
  return nullptr;
}

/// `margin`: within a box, whose corners it makes round; around a hull; a capsule has its own [m].
inline std::shared_ptr<btConvexShape> BulletSolid(const PlainConvex& convex, double margin) {
  switch (convex.kind) {
    case PlainConvex::Kind::kCapsule:
      return std::make_shared<btCapsuleShapeZ>(BulletNumber(convex.radius),
                                               BulletNumber(2 * convex.half[2]));
    case PlainConvex::Kind::kBox: {
      auto box = std::make_shared<btBoxShape>(BulletVector(convex.half));
      box->setMargin(BulletNumber(margin));
      return box;
    }
    case PlainConvex::Kind::kHull:
      break;
  }
  auto hull = std::make_shared<btConvexHullShape>();
  for (const auto& p : convex.hull.vertices) hull->addPoint(BulletVector(p), false);
  hull->recalcLocalAabb();
  hull->setMargin(BulletNumber(margin));
  return hull;
}

/// The last one is what Bullet gives its shapes by default [m].
inline constexpr double kBulletMargins[] = {0, 1e-6, 1e-4, 1e-3, 1e-2, 0.04};

}  // namespace collision::bench
