// Bullet's continuous collision of convex shapes in all its kinds.
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "tests/bench/pairs/peers.h"
#include "tests/bench/peers/bullet_types.h"

namespace collision::bench {
namespace {

enum class Cast { kContinuous, kGjk, kSubSimplex };

struct Setting {
  double allowed_penetration = 0;
  double epsilon = 0;  ///< Of the sub-simplex cast; 0: its own.
};

ContactReply Tell(const ContactCase& of, const btConvexShape& a, const btConvexShape& b, Cast cast,
                  const Setting& setting) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btContinuousConvexCollision continuous(&a, &b, &simplex, &depth);
  btGjkConvexCast gjk(&a, &b, &simplex);
  btSubsimplexConvexCast sub_simplex(&a, &b, &simplex);
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  result.m_allowedPenetration = BulletNumber(setting.allowed_penetration);
  if (setting.epsilon > 0) {
    result.m_subSimplexCastEpsilon = BulletNumber(setting.epsilon);
    result.m_subSimplexCastMaxIterations = 1000;
  }
  btConvexCast& chosen = cast == Cast::kContinuous ? static_cast<btConvexCast&>(continuous)
                         : cast == Cast::kGjk      ? static_cast<btConvexCast&>(gjk)
                                                   : static_cast<btConvexCast&>(sub_simplex);
  if (!chosen.calcTimeOfImpact(BulletPose(of.a), BulletPose(of.a.After(of.duration)),
                               BulletPose(of.b), BulletPose(of.b.After(of.duration)), result)) {
    return {};
  }
  return Plainly(static_cast<double>(result.m_fraction) * of.duration);
}

void Add(const std::string& name, Cast cast, const Setting& setting, const std::string& text,
         ContactMethods* methods) {
  ContactMethod method;
  method.name = name;
  method.setting = text;
  method.limited_by = cast == Cast::kContinuous
                          ? "single precision, 1 mm of distance and 64 iterations"
                          : "single precision and its iterations; translation only";
  method.make = [cast, setting](const ContactCase& of) -> ContactQuery {
    const auto a = BulletShape(of.a), b = BulletShape(of.b);
    if (!a || !b) return nullptr;
    const bool turns = of.a.w != std::array<double, 3>{} || of.b.w != std::array<double, 3>{};
    if (cast != Cast::kContinuous && turns) return nullptr;
    return [of, a, b, cast, setting] { return Tell(of, *a, *b, cast, setting); };
  };
  methods->push_back(std::move(method));
}

}  // namespace

ContactMethods BulletContact() {
  ContactMethods methods;
  Add("Bullet convex", Cast::kContinuous, {}, "", &methods);
  return methods;
}

ContactMethods BulletContactCurves() {
  ContactMethods methods;
  for (const double allowed : {0.0, 1e-4, 1e-3, 1e-2, 0.04}) {
    Add("Bullet continuous", Cast::kContinuous, {allowed, 0},
        SettingText("penetration", allowed, "m"), &methods);
  }
  Add("Bullet GJK cast", Cast::kGjk, {}, "", &methods);
  for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    Add("Bullet sub-simplex cast", Cast::kSubSimplex, {0, epsilon},
        SettingText("epsilon", epsilon, ""), &methods);
  }
  return methods;
}

}  // namespace collision::bench
