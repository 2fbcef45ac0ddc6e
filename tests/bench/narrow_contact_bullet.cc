// Bullet's continuous collision of two convex shapes.
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <memory>

#include "tests/bench/narrow_contact_case.h"

namespace collision::bench {
namespace {

btScalar Single(double x) { return static_cast<btScalar>(x); }

btVector3 Vector(const std::array<double, 3>& v) {
  return btVector3(Single(v[0]), Single(v[1]), Single(v[2]));
}

btTransform PoseOf(const MovingBody& body) {
  return btTransform(
      btQuaternion(Single(body.q[1]), Single(body.q[2]), Single(body.q[3]), Single(body.q[0])),
      Vector(body.p));
}

std::unique_ptr<btConvexShape> ShapeOf(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBall) {
    return std::make_unique<btSphereShape>(Single(body.half[0]));
  }
  return std::make_unique<btBoxShape>(Vector(body.half));
}

std::optional<double> Tell(const ContactCase& of) {
  const auto a = ShapeOf(of.a), b = ShapeOf(of.b);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btContinuousConvexCollision cast(a.get(), b.get(), &simplex, &depth);
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  const bool hit = cast.calcTimeOfImpact(PoseOf(of.a), PoseOf(of.a.After(of.duration)),
                                         PoseOf(of.b), PoseOf(of.b.After(of.duration)), result);
  if (!hit) return std::nullopt;
  return static_cast<double>(result.m_fraction) * of.duration;
}

}  // namespace

std::vector<ContactLibrary> BulletContact() { return {{"Bullet convex", Tell}}; }

}  // namespace collision::bench
