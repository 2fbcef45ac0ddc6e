// The moving cubes as the broad phase sees them.
#pragma once

#include "collision_core/broad_phase/neighbour_index.h"
#include "tests/baselines/ball_bound.h"
#include "tests/baselines/moving_cubes.h"

namespace collision::baselines {

/// A frame as an instant, exactly.
inline Instant InstantOf(const MovingCubes& cubes, std::int64_t frames_later = 0) {
  return Instant::FromNanoseconds((cubes.frame() + frames_later) * MovingCubes::kFrameNs);
}

/// The horn of one cube's ball from the present frame on.
inline motion::SpaceTimeBound BoundOf(const MovingCubes& cubes, std::uint32_t cube) {
  motion::SpaceTimeBound bound = BoundOf(cubes.Ball(cube));
  bound.state.stamp = InstantOf(cubes);
  return bound;
}

/// Appends every pair that may first meet at or after `from`, by `until`.
void AllNeighbours(broad_phase::NeighbourIndex* phase, std::uint32_t agents, Instant from,
                   Instant until, std::vector<intersection::IntersectingPair>* meetings);

}  // namespace collision::baselines
