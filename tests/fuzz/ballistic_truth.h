// Balls that fly on as they were last told to: one motion that every bound allows, and so one that
// every promise must hold for.
#pragma once

#include <cstdint>

#include "collision_core/motion/motion_state.h"

namespace collision::fuzz {

struct Ballistic {
  motion::MotionState state;
  double radius = 0;
};

/// Whether the two overlap at `t` by more than rounding. In numbers of 113
/// bits, from the definition: no code of the core's.
bool CertainlyOverlap(const Ballistic& a, const Ballistic& b, Instant t);

/// Whether they are apart at `t` by as much.
bool CertainlyApart(const Ballistic& a, const Ballistic& b, Instant t);

/// The nanosecond in [from, until] at which they are nearest.
Instant NearestWithin(const Ballistic& a, const Ballistic& b, Instant from, Instant until);

}  // namespace collision::fuzz
