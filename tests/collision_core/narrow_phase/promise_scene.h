// Two random bodies that nearly touch at some instant, and the states that they send: for tests of
// promises.
#pragma once

#include "tests/support/meshes.h"
#include "tests/support/truth/true_distance.h"

namespace collision {

// The oracle's own error, in units of the bodies' size.
inline constexpr Real kOracle = 1e-12L;

inline std::shared_ptr<const shape::Shape> RandomShape(Random& random, double size) {
  switch (random.Below(8)) {
    case 0:
      return shape::Shape::Build(Scaled(Cube(1), size));
    case 1:
      return shape::Shape::Build(Scaled(Tetrahedron(1), size));
    case 2:
      return shape::Shape::Build(Scaled(LShape(), size));
    case 3:
      return shape::Shape::Build(Scaled(Rod(2, 0.1), size));
    case 4:
      return shape::Shape::Build(Scaled(Sheet(1, 2), size));
    case 5:
      return shape::Shape::Build(Scaled(Star(1, random), size));
    case 6:
      return shape::Shape::Build(Scaled(Moved(Frame(), {0.5, 0, 0}), size));
    default:
      return nullptr;
  }
}

struct Agent {
  std::shared_ptr<const shape::Shape> shape;
  motion::MotionLimits limits;
  TrueMotion motion;
};

// Constant, or towards one side and then the other; often as hard as allowed.
inline std::vector<TrueMotion::Piece> RandomPieces(Random& random, double duration, double M,
                                                   double alpha) {
  const Vector a = RandomUnit(random), w = RandomUnit(random);
  const double strength = random.Chance(0.7) ? 1 : random.Uniform(0, 1);
  const double turn_at = random.Chance(0.5) ? 0.5 * duration : random.Uniform(0, duration);
  const int back = random.Chance(0.6) ? -1 : 1;
  return {{turn_at, strength * M * a, strength * alpha * w},
          {duration, back * strength * M * a, back * strength * alpha * w}};
}

struct Scene {
  double duration = 0;
  Agent agents[2];
  bool last[2], next[2];

  TrueBody Body(int i, Real t) const {
    return {agents[i].shape.get(), agents[i].limits.radius, agents[i].motion.At(t)};
  }
  Real Distance(Real t) const { return SolidDistance(Body(0, t), Body(1, t)); }

  narrow_phase::BodySegment Segment(int i) const {
    const Agent& agent = agents[i];
    narrow_phase::BodySegment segment;
    segment.ball.radius = agent.limits.radius;
    segment.shape = agent.shape;
    const Instant base = Instant::FromNanoseconds(0);
    if (last[i]) {
      const motion::SpaceTimeBound bound = BoundAt(agent.motion, 0, agent.limits);
      segment.ball.bounds.push_back(ForwardBall(bound, base));
      if (agent.shape) segment.turns.push_back(ForwardRotation(bound, base));
    }
    if (next[i]) {
      const motion::SpaceTimeBound bound = BoundAt(agent.motion, duration, agent.limits);
      segment.ball.bounds.push_back(BackwardBall(bound, base));
      if (agent.shape) segment.turns.push_back(BackwardRotation(bound, base));
    }
    return segment;
  }
};

inline Scene RandomScene(Random& random) {
  Scene scene;
  scene.duration = std::ldexp(1.0, -static_cast<int>(random.Below(7)));  // whole nanoseconds
  const double size = random.LogUniform(0.1, 10);
  // How much of the bodies' size a motion moves them within the segment, by turning and otherwise.
  const double pace = random.LogUniform(1e-3, 3) / scene.duration;
  const double uncertain =
      random.Chance(0.3) ? 0 : random.LogUniform(1e-6, 0.3) / scene.duration / scene.duration;
  for (int i = 0; i < 2; ++i) {
    Agent& agent = scene.agents[i];
    agent.shape = RandomShape(random, size * random.LogUniform(0.3, 3));
    if (i == 1 && !agent.shape && !scene.agents[0].shape)
      agent.shape = shape::Shape::Build(Cube(size));
    motion::MotionLimits& limits = agent.limits;
    limits.radius = agent.shape ? agent.shape->facts().radius : size * random.LogUniform(0.1, 1);
    const bool steady = random.Chance(0.3);
    limits.acceleration_max = steady ? 0 : 2 * uncertain * limits.radius;
    limits.angular_acceleration_max = random.Chance(0.3) ? 0 : 2 * uncertain;
    TruePose& start = agent.motion.start;
    start.q = RandomTurn(random);
    start.v = pace * limits.radius * RandomUnit(random);
    if (random.Chance(0.8)) start.w = pace * RandomUnit(random);
    agent.motion.pieces = RandomPieces(random, scene.duration, limits.acceleration_max,
                                       limits.angular_acceleration_max);
    const bool forward_only = random.Chance(0.4), backward_only = random.Chance(0.2);
    scene.last[i] = forward_only || !backward_only;
    scene.next[i] = !forward_only;
  }
  // Moved along a random direction until at some time they are just apart, or just not.
  const Real t = scene.duration * random.Uniform(0, 1);
  const Vector direction = RandomUnit(random), p_0 = scene.agents[0].motion.At(t).p;
  Vector& start = scene.agents[1].motion.start.p;
  const Vector here = p_0 - scene.agents[1].motion.At(t).p;
  const Real reach = scene.agents[0].limits.radius + scene.agents[1].limits.radius;
  Real near = 0, far = 1.01L * reach;
  for (int i = 0; i < 30; ++i) {
    const Real middle = (near + far) / 2;
    start = here + middle * direction;
    (scene.Distance(t) > 0 ? far : near) = middle;
  }
  const double clearance = static_cast<double>(reach) * random.LogUniform(1e-9, 1e-1);
  start = here + (far + (random.Chance(0.5) ? clearance : -clearance)) * direction;
  return scene;
}

}  // namespace collision
