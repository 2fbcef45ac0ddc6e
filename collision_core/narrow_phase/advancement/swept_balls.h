// When two balls that move on straight lines, while their radii grow, may touch first.
#pragma once

#include <Eigen/Core>

#include "collision_core/narrow_phase/advancement/swept_pose.h"

namespace collision::narrow_phase {

/// Two balls seen from the centre of one: `d` [m] to the other centre, which moves with `w` [m/s];
/// `reach` bounds the sum of their radii and of all uncertainty from above, as it grows with time.
struct SweptBalls {
  Eigen::Vector3d d, w;
  SweptPose::Growth reach;
};

/// A time [s] up to which the balls are apart: |d + w h| > reach(h) for every h before it;
/// +infinity if that holds up to `duration`. Takes steps of the tangent of the distance: at each h
/// the distance is at least its part along the direction at h, so no step goes too far. Ends after
/// a few steps, or when one gains less than `step_worth` of the duration: the time is then early,
/// never late.
double SweptBallsTouch(const SweptBalls& balls, double duration, double step_worth);

}  // namespace collision::narrow_phase
