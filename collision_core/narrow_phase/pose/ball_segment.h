// What is certain about one ball over a segment of time.
#pragma once

#include <vector>

#include "collision_core/motion/space_time_bound.h"

namespace collision::narrow_phase {

/// What is certain about one ball over [base, base + duration]: every bound in `bounds` holds at
/// every instant of it (forward from the last known state, backward from the next one). Empty:
/// nothing is known. `radius` counts for all of them, in place of their own.
struct BallSegment {
  double radius = 0;
  std::vector<numeric::MovingBall> bounds;
};

}  // namespace collision::narrow_phase
