// What is certain about one agent over a segment of time.
#pragma once

#include <memory>
#include <vector>

#include "collision_core/motion/moving_rotation.h"
#include "collision_core/narrow_phase/pose/ball_segment.h"
#include "collision_core/shape/fixed_half_space.h"
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
  /// The body is this half-space, for which ReplaceHalfSpace() has still to put a block; null: not.
  std::shared_ptr<const shape::FixedHalfSpace> half_space;

  bool is_ball() const { return !shape && !awaited && !half_space; }
};

/// Two bodies over the same segment of time.
struct BodyPair {
  BodySegment a, b;
};

/// If one of the two is a half-space, puts the block in its place that looks endless to the other
/// one for `duration` seconds; after that it is a body like any other. Where the other may be
/// anywhere, or is too large for a block, nothing is known of the half-space either. Requires that
/// not both are half-spaces.
///
/// Every claim that follows is one about the true motion of the other body, which lies in each of
/// its balls: so the block has to look endless from the smallest of them only.
void ReplaceHalfSpace(double duration, BodyPair* bodies);

}  // namespace collision::narrow_phase
