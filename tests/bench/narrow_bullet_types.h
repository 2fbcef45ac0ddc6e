// A pose as Bullet takes it.
#pragma once

#include <LinearMath/btTransform.h>

#include "tests/bench/narrow_query.h"

namespace collision::bench {

inline btTransform BulletPose(const PlainPose& at) {
  const auto number = [](double x) { return static_cast<btScalar>(x); };
  const auto& r = at.rotation;
  return btTransform(btMatrix3x3(number(r[0][0]), number(r[0][1]), number(r[0][2]), number(r[1][0]),
                                 number(r[1][1]), number(r[1][2]), number(r[2][0]), number(r[2][1]),
                                 number(r[2][2])),
                     btVector3(number(at.offset[0]), number(at.offset[1]), number(at.offset[2])));
}

}  // namespace collision::bench
