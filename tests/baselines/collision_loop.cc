#include "tests/baselines/collision_loop.h"

namespace collision::baselines {

FirstCollision FindFirstCollision(MovingCubes* cubes, std::int64_t frames, CollisionLoop* loop) {
  for (std::int64_t i = 0; i < frames; ++i, cubes->NextFrame()) {
    if (const auto pair = loop->Look(*cubes)) return {cubes->frame(), *pair};
  }
  return {};
}

}  // namespace collision::baselines
