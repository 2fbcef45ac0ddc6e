// Balls and boxes that move, as Bullet takes them.
#pragma once

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <memory>

#include "tests/bench/narrow_contact_case.h"

namespace collision::bench {

inline btScalar BulletNumber(double x) { return static_cast<btScalar>(x); }

inline btVector3 BulletVector(const std::array<double, 3>& v) {
  return btVector3(BulletNumber(v[0]), BulletNumber(v[1]), BulletNumber(v[2]));
}

inline btTransform BulletPose(const MovingBody& body) {
  const auto& [w, x, y, z] = body.q;
  return btTransform(
      btQuaternion(BulletNumber(x), BulletNumber(y), BulletNumber(z), BulletNumber(w)),
      BulletVector(body.p));
}

inline std::shared_ptr<btConvexShape> BulletShape(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBall) {
    return std::make_shared<btSphereShape>(BulletNumber(body.half[0]));
  }
  return std::make_shared<btBoxShape>(BulletVector(body.half));
}

}  // namespace collision::bench
