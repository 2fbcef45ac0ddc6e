// Vectors and poses, at random and by hand, for the checker's tests.
#pragma once

#include "client/checker/shape/vector.h"
#include "tests/support/random.h"

namespace collision::checker {

/// Each coordinate within ±size.
inline Vector RandomVector(Random* random, double size) {
  return {random->Uniform(-size, size), random->Uniform(-size, size), random->Uniform(-size, size)};
}

/// Turned in any way; each coordinate of the position within ±size.
inline Pose RandomPose(Random* random, double size) {
  Vector axes[3];
  axes[0] = RandomVector(random, 1);
  axes[0] = 1 / Length(axes[0]) * axes[0];
  axes[1] = Cross(axes[0], RandomVector(random, 1));
  axes[1] = 1 / Length(axes[1]) * axes[1];
  axes[2] = Cross(axes[0], axes[1]);
  return {{axes[0], axes[1], axes[2]}, RandomVector(random, size)};
}

/// Not turned.
inline Pose At(const Vector& p) { return {Pose().R_AB, p}; }

}  // namespace collision::checker
