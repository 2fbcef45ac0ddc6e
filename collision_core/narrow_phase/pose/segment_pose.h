// The relative pose of two bodies at an instant of a segment of time.
//
// At each instant the least uncertain of the bounds that hold (forward, backward) is used. B is
// posed in A's body frame, positions subtracted first, so that far from the origin nothing is lost
// but what the states lost.
#pragma once

#include <cstddef>

#include "collision_core/narrow_phase/pose/body_segment.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"

namespace collision::narrow_phase {

/// The bounds of A and of B that leave the least uncertainty at an instant; `certain` is false
/// where nothing is known of one of them.
struct BoundChoice {
  std::size_t of_a = 0;
  std::size_t of_b = 0;
  bool certain = false;
};
BoundChoice BestBounds(const BodySegment& a, const BodySegment& b, double delta);

/// The pose at `delta` seconds after the segments' base, from the chosen bounds.
RelativePose PoseAt(const BodySegment& a, const BodySegment& b, BoundChoice choice, double delta);

/// No point that turning moves is farther from the reference point [m]; 0 for a ball.
inline double TurningReachOf(const BodySegment& body) {
  return body.shape ? body.shape->facts().radius : 0;
}

}  // namespace collision::narrow_phase
