// Bullet's continuous collision of two convex shapes.
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "tests/bench/narrow_bullet_bodies.h"

namespace collision::bench {
namespace {

std::optional<double> Tell(const ContactCase& of) {
  const auto a = BulletShape(of.a), b = BulletShape(of.b);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btContinuousConvexCollision cast(a.get(), b.get(), &simplex, &depth);
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  const bool hit =
      cast.calcTimeOfImpact(BulletPose(of.a), BulletPose(of.a.After(of.duration)), BulletPose(of.b),
                            BulletPose(of.b.After(of.duration)), result);
  if (!hit) return std::nullopt;
  return static_cast<double>(result.m_fraction) * of.duration;
}

}  // namespace

std::vector<ContactLibrary> BulletContact() { return {{"Bullet convex", Tell}}; }

}  // namespace collision::bench
