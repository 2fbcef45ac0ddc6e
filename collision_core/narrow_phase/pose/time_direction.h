// Which way a query goes through a segment of time.
#pragma once

#include "collision_core/numeric/cubic.h"

namespace collision::narrow_phase {

/// From the start of a segment towards its end, or from its end towards its start.
enum class TimeDirection { kForward, kBackward };

/// The cubic as a function of the seconds that have passed since `at` in this direction.
inline numeric::Cubic From(const numeric::Cubic& cubic, double at, TimeDirection direction) {
  return direction == TimeDirection::kBackward ? cubic.BackwardFrom(at) : cubic.From(at);
}

}  // namespace collision::narrow_phase
