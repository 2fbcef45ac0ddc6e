// Boxes and leaves as Bullet has them.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <cstdint>

#include "tests/baselines/ball_scene.h"
#include "tests/bench/peers/float_box.h"

namespace collision::bench {

inline btDbvtVolume BulletBox(const baselines::SweptBox& box) {
  return btDbvtVolume::FromMM(
      {RoundedDown(box.lower[0]), RoundedDown(box.lower[1]), RoundedDown(box.lower[2])},
      {RoundedUp(box.upper[0]), RoundedUp(box.upper[1]), RoundedUp(box.upper[2])});
}

inline std::uint32_t AgentOf(const btDbvtNode* leaf) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(leaf->data));
}

}  // namespace collision::bench
