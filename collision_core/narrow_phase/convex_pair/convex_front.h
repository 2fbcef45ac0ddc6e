// How far a moving convex set reaches along a direction.
#pragma once

#include "collision_core/geometry/convex/convex_set.h"

namespace collision::narrow_phase {

/// A body's points x move along their tangents, with velocity + spin × (x − about).
struct TangentMotion {
  Eigen::Vector3d velocity{0, 0, 0};  ///< Velocity of `about` [m/s].
  Eigen::Vector3d spin{0, 0, 0};      ///< [rad/s]
  Eigen::Vector3d about{0, 0, 0};     ///< The body's reference point [m].
};

/// Both rounded up, and certain for the set as it is to within its `error`.
struct MovingFront {
  double front = 0;  ///< The greatest n·(x + h v(x) − origin) over the set [m].
  double fastest = 0;  ///< The greatest n·v(x): h + δ later the front is at most front + δ fastest.
};

/// n·(x + h v(x)) = n·x + h n·velocity + h (n × spin)·(x − about): again the reach along one
/// direction, n + h (n × spin). Requires |n| within 2^-20 of 1 and h >= 0. For two sets A and B the
/// gap along n at h is −front_B(−n) − front_A(n).
MovingFront FrontOf(const geometry::ConvexSet& set, const TangentMotion& motion,
                    const Eigen::Vector3d& n, const Eigen::Vector3d& origin, double h);

}  // namespace collision::narrow_phase
