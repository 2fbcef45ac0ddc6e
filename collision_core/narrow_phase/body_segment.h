// What is certain about one agent over a segment of time.
#pragma once

#include <memory>
#include <vector>

#include "collision_core/motion/moving_turn.h"
#include "collision_core/narrow_phase/ball_contact.h"
#include "collision_core/shape/shape.h"

namespace collision {

/// An agent's ball, and where it has a shape, its turning: `turns[i]` holds together with
/// `ball.bounds[i]`. Every claim made with any of them holds.
struct BodySegment {
  BallSegment ball;
  std::vector<MovingTurn> turns;       ///< Empty for a ball.
  std::shared_ptr<const Shape> shape;  ///< Null: the ball itself, or see `awaited`.
  bool awaited = false;  ///< Somewhere within the ball: it can exclude contacts, not confirm them.

  bool is_ball() const { return !shape && !awaited; }
};

}  // namespace collision
