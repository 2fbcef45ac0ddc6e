// A caller's record as the service's bound.
#pragma once

#include "collision_core/motion/space_time_bound.h"
#include "collision_core/numeric/seconds.h"
#include "tests/baselines/ball_scene.h"

namespace collision::baselines {

/// The same agent; the scene's start is instant 0.
inline motion::SpaceTimeBound BoundOf(const BallAgent& agent) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = numeric::AddRoundedDown(Instant(), agent.stamp);
  bound.state.p_WA = agent.p_WA;
  bound.state.v_WA = agent.v_WA;
  bound.limits.radius = agent.radius;
  bound.limits.acceleration_max = agent.acceleration_max;
  return bound;
}

}  // namespace collision::baselines
