// What is certain about one agent over a segment of time.
#pragma once

#include <memory>
#include <vector>

#include "collision_core/motion/moving_rotation.h"
#include "collision_core/narrow_phase/pose/ball_segment.h"
#include "collision_core/shape/shape.h"

namespace collision::narrow_phase {

/// What is certain about one agent over a segment of time: its ball and, for a shape, its turning.
/// `turns[i]` holds together with `ball.bounds[i]`. Every claim made with any pair of them holds.
struct BodySegment {
  BallSegment ball;
  std::vector<motion::MovingRotation> turns;  ///< Empty for a ball.
  std::shared_ptr<const shape::Shape> shape;  ///< Null: the ball itself, or see `awaited`.
  /// The shape is not known yet: the body is somewhere within the ball, which can exclude contacts
  /// but not confirm them.
  bool awaited = false;

  bool is_ball() const { return !shape && !awaited; }
};

}  // namespace collision::narrow_phase
