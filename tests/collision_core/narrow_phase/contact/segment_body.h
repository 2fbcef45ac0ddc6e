// A body that moves uniformly over a segment of time, given by states at its start and at its end.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "collision_core/narrow_phase/pose/body_segment.h"
#include "collision_core/shape/shape.h"

namespace collision::narrow_phase {

/// Of the segment.
inline const Instant kSegmentBase = Instant::FromNanoseconds(0);

struct SegmentBody {
  std::shared_ptr<const shape::Shape> shape = nullptr;
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  double M = 0;
  double radius = 0;  ///< Of a ball.
  double alpha = 0;

  motion::SpaceTimeBound BoundAt(double stamp) const {
    motion::SpaceTimeBound bound;
    bound.state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(stamp * 1e9));
    bound.state.p_WA = p + stamp * v;
    bound.state.v_WA = v;
    bound.state.w_WB = w;
    const double angle = w.norm() * stamp;
    if (angle > 0) bound.state.q_WB = Eigen::AngleAxisd(angle, w.normalized());
    bound.state.rotation_error = 1e-14;
    bound.limits.radius = shape ? shape->facts().radius : radius;
    bound.limits.acceleration_max = M;
    bound.limits.angular_acceleration_max = alpha;
    return bound;
  }

  /// A segment from the states at 0 and at `next`, as far as they exist.
  BodySegment Segment(std::optional<double> next = {}, bool last = true) const {
    BodySegment segment;
    segment.ball.radius = BoundAt(0).limits.radius;
    segment.shape = shape;
    if (last) {
      Add(ForwardBall(BoundAt(0), kSegmentBase), ForwardRotation(BoundAt(0), kSegmentBase),
          &segment);
    }
    if (next) {
      Add(BackwardBall(BoundAt(*next), kSegmentBase),
          BackwardRotation(BoundAt(*next), kSegmentBase), &segment);
    }
    return segment;
  }

 private:
  void Add(const numeric::MovingBall& ball, const motion::MovingRotation& turn,
           BodySegment* segment) const {
    segment->ball.bounds.push_back(ball);
    if (shape) segment->turns.push_back(turn);
  }
};

}  // namespace collision::narrow_phase
