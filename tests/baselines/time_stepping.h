// The naive loop: every pair in every frame.
#pragma once

#include "tests/baselines/collision_loop.h"

namespace collision::baselines {

/// Sees what overlaps in a frame, and never what overlapped between two.
class TimeStepping : public CollisionLoop {
 public:
  std::optional<CubePair> Look(const MovingCubes& cubes) override {
    std::optional<CubePair> first;
    for (std::uint32_t a = 0; a < cubes.count(); ++a) {
      for (std::uint32_t b = a + 1; b < cubes.count(); ++b) Test(cubes, a, b, &first);
    }
    return first;
  }
};

}  // namespace collision::baselines
