#include "collision_core/narrow_phase/pose/body_segment.h"

#include <algorithm>
#include <utility>

namespace collision::narrow_phase {
namespace {

/// A ball that does not move, and contains another one for a while.
struct RestingBall {
  Eigen::Vector3d centre;
  double radius = numeric::kInfinity;
};

/// The growing part of the radius is convex: it is greatest at one of the two ends.
RestingBall Around(const numeric::MovingBall& ball, double radius, double duration) {
  const Eigen::Vector3d centre = ball.centre().middle();
  const double off = numeric::Norm(ball.centre() - numeric::IntervalVector(centre)).upper;
  const numeric::Interval time(duration);
  numeric::Interval path = time * numeric::Norm(ball.velocity);
  if (ball.bends) path = path + time * time * numeric::Norm(ball.bend);
  const double grown = std::max(ball.u.At(0).upper, ball.u.At(duration).upper);
  const numeric::Interval all = numeric::Interval(radius) + off + path + grown;
  return {centre, all.upper};
}

RestingBall Smallest(const BallSegment& ball, double duration) {
  RestingBall smallest;
  for (const numeric::MovingBall& bound : ball.bounds) {
    const RestingBall around = Around(bound, ball.radius, duration);
    if (around.radius < smallest.radius) smallest = around;
  }
  return smallest;
}

void Replace(const BodySegment& other, double duration, BodySegment* body) {
  const auto half_space = std::exchange(body->half_space, nullptr);
  const bool known = !body->ball.bounds.empty();
  body->ball.bounds.clear();
  body->awaited = true;
  const RestingBall around = Smallest(other.ball, duration);
  if (!known || around.radius == numeric::kInfinity) return;
  const auto block = half_space->Around(around.centre, around.radius);
  if (!block) return;
  body->awaited = false;
  body->shape = block->shape;
  body->ball.radius = block->shape->facts().radius;
  const numeric::IntervalVector still(Eigen::Vector3d(0, 0, 0));
  body->ball.bounds.push_back(
      {numeric::IntervalVector(block->position),
       still,
       still,
       numeric::Interval(body->ball.radius),
       {numeric::Interval(block->error), numeric::Interval(0), numeric::Interval(0)}});
  motion::MovingRotation turn;
  turn.angle_error = {numeric::Interval(block->tilt), numeric::Interval(0), numeric::Interval(0)};
  body->turns = {turn};
}

}  // namespace

void ReplaceHalfSpace(double duration, BodyPair* bodies) {
  CORE_CHECK(!bodies->a.half_space || !bodies->b.half_space, "two half-spaces never meet");
  if (bodies->a.half_space) Replace(bodies->b, duration, &bodies->a);
  if (bodies->b.half_space) Replace(bodies->a, duration, &bodies->b);
}

}  // namespace collision::narrow_phase
