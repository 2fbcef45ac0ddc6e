#include "collision_core/detection/agents/scene_extremes.h"

#include <algorithm>

namespace collision::detection {

void SceneExtremes::Bounds::Include(const motion::SpaceTimeBound& bound) {
  const motion::MotionState& state = bound.state;
  oldest = std::min(oldest, state.stamp);
  newest = std::max(newest, state.stamp);
  speed_max = std::max(speed_max, state.v_WA.norm() + state.velocity_error);
  position_error_max = std::max(position_error_max, state.position_error);
  acceleration_max = std::max(acceleration_max, bound.limits.acceleration_max + state.a_WA.norm());
  jerk_max = std::max(jerk_max, bound.limits.jerk_max);
  time_step_max = std::max(time_step_max, bound.limits.time_step);
}

bool SceneExtremes::Bounds::Holds(const motion::SpaceTimeBound& bound) const {
  Bounds with = *this;
  with.Include(bound);
  return with == *this;
}

}  // namespace collision::detection
