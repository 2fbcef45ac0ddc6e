// Bodies at a pose: convex, hollow, open, spiky, thin, or a ball.
#pragma once

#include "collision_core/narrow_phase/pose/segment_pose.h"
#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/support/meshes.h"
#include "tests/support/truth/true_distance.h"

namespace collision {

/// At rest.
struct Posed {
  std::shared_ptr<const shape::Shape> shape;
  double radius = 0;
  TruePose pose;

  narrow_phase::BodySegment Segment() const {
    TrueMotion motion;
    motion.start = pose;
    motion::MotionLimits limits;
    limits.radius = radius;
    limits.angular_acceleration_max = 0;
    const motion::SpaceTimeBound bound = BoundAt(motion, 0, limits);
    narrow_phase::BodySegment segment;
    segment.shape = shape;
    segment.ball.radius = radius;
    const Instant base = Instant::FromNanoseconds(0);
    segment.ball.bounds.push_back(ForwardBall(bound, base));
    if (shape) segment.turns.push_back(ForwardRotation(bound, base));
    return segment;
  }
  TrueBody Body() const { return {shape.get(), radius, pose}; }
};

inline Posed RandomBody(Random& random, double size, const Vector& p) {
  const geometry::TriangleMesh meshes[] = {
      Cube(1), Tetrahedron(1), LShape(), Sheet(1, 3), Star(1, random), Frame(), Rod(3, 0.01)};
  Posed posed;
  const std::uint64_t kind = random.Below(8);
  if (kind < 7) posed.shape = shape::Shape::Build(Scaled(meshes[kind], size));
  posed.radius = posed.shape ? posed.shape->facts().radius : size;
  posed.pose.p = p;
  posed.pose.q = RandomTurn(random);
  return posed;
}

/// The first one seen from the second, in the narrow phase's terms.
inline narrow_phase::RelativePose PoseBetween(const narrow_phase::BodySegment& a,
                                              const narrow_phase::BodySegment& b) {
  return PoseAt(a, b, {0, 0, true}, 0);
}

}  // namespace collision
