// Goal:   whatever is said of two shapes over a segment of time holds for every motion within the bounds.
// Method: motions with random and extreme accelerations, in long double; states taken from them before and after
//         the segment; two bodies moved so that they nearly touch within it. Every verdict is held against the
//         true distance: apart where it says apart, together where it says contact, points where they are said to be.
#include <gtest/gtest.h>

#include "collision_core/narrow_phase/shape_contact.h"
#include "tests/collision_core/narrow_phase/true_motion.h"
#include "tests/support/meshes.h"

namespace collision {
namespace {

// The oracle's own error, in units of the bodies' size.
constexpr Real kOracle = 1e-12L;

std::shared_ptr<const Shape> RandomShape(Random& random, double size) {
  switch (random.Below(8)) {
    case 0:
      return Shape::Build(Scaled(Cube(1), size));
    case 1:
      return Shape::Build(Scaled(Tetrahedron(1), size));
    case 2:
      return Shape::Build(Scaled(LShape(), size));
    case 3:
      return Shape::Build(Scaled(Rod(2, 0.1), size));
    case 4:
      return Shape::Build(Scaled(Sheet(1, 2), size));
    case 5:
      return Shape::Build(Scaled(Star(1, random), size));
    case 6:
      return Shape::Build(Scaled(Moved(Frame(), {0.5, 0, 0}), size));
    default:
      return nullptr;
  }
}

struct Agent {
  std::shared_ptr<const Shape> shape;
  AgentDeclaration declaration;
  TrueMotion motion;
};

// Constant, or towards one side and then the other; often as hard as allowed.
std::vector<TrueMotion::Piece> RandomPieces(Random& random, double duration, double M,
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
    return {agents[i].shape.get(), agents[i].declaration.radius, agents[i].motion.At(t)};
  }
  Real Distance(Real t) const { return SolidDistance(Body(0, t), Body(1, t)); }

  BodySegment Segment(int i) const {
    const Agent& agent = agents[i];
    BodySegment segment;
    segment.ball.radius = agent.declaration.radius;
    segment.shape = agent.shape;
    const Instant base = Instant::FromNanoseconds(0);
    if (last[i]) {
      const SpaceTimeBound bound = BoundAt(agent.motion, 0, agent.declaration);
      segment.ball.bounds.push_back(ForwardBall(bound, base));
      if (agent.shape) segment.turns.push_back(ForwardTurn(bound, base));
    }
    if (next[i]) {
      const SpaceTimeBound bound = BoundAt(agent.motion, duration, agent.declaration);
      segment.ball.bounds.push_back(BackwardBall(bound, base));
      if (agent.shape) segment.turns.push_back(BackwardTurn(bound, base));
    }
    return segment;
  }
};

Scene RandomScene(Random& random) {
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
    if (i == 1 && !agent.shape && !scene.agents[0].shape) agent.shape = Shape::Build(Cube(size));
    AgentDeclaration& declaration = agent.declaration;
    declaration.radius =
        agent.shape ? agent.shape->facts().radius : size * random.LogUniform(0.1, 1);
    declaration.shape = agent.shape;
    const bool steady = random.Chance(0.3);
    declaration.acceleration_max = steady ? 0 : 2 * uncertain * declaration.radius;
    declaration.angular_acceleration_max = random.Chance(0.3) ? 0 : 2 * uncertain;
    TruePose& start = agent.motion.start;
    start.q = RandomTurn(random);
    start.v = pace * declaration.radius * RandomUnit(random);
    if (random.Chance(0.8)) start.w = pace * RandomUnit(random);
    agent.motion.pieces = RandomPieces(random, scene.duration, declaration.acceleration_max,
                                       declaration.angular_acceleration_max);
    const bool forward_only = random.Chance(0.4), backward_only = random.Chance(0.2);
    scene.last[i] = forward_only || !backward_only;
    scene.next[i] = !forward_only;
  }
  // Moved along a random direction until at some time they are just apart, or just not.
  const Real t = scene.duration * random.Uniform(0, 1);
  const Vector direction = RandomUnit(random), p_0 = scene.agents[0].motion.At(t).p;
  Vector& start = scene.agents[1].motion.start.p;
  const Vector here = p_0 - scene.agents[1].motion.At(t).p;
  const Real reach = scene.agents[0].declaration.radius + scene.agents[1].declaration.radius;
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

struct Count {
  int free = 0, contact = 0, undecided = 0, partly_free = 0, confirmed = 0, points = 0;
};

void CheckNearest(const Scene& scene, const ShapeVerdict& verdict, Real tolerance, Count* count) {
  const Real at = verdict.nearest_at;
  const Proximity& found = verdict.nearest;
  const TrueBody a = scene.Body(0, at), b = scene.Body(1, at);
  const Real solids = SolidDistance(a, b);
  EXPECT_LE(found.separation.lower, found.separation.upper);
  EXPECT_LE(found.separation.lower, SurfaceDistance(a, b) + tolerance);
  if (found.separation.upper < 0) {
    EXPECT_EQ(solids, 0);
    ++count->contact;
    // Nothing shorter than the depth takes them apart.
    for (int i = 0; i < 6; ++i) {
      const Vector by = Vector::Unit(i / 2) * ((i % 2 ? 1 : -1) * found.depth_lower * 0.999L);
      EXPECT_EQ(SolidDistance(a, b.Moved(by)), 0) << "depth " << found.depth_lower;
    }
    // But as much as the other bound says does.
    const Vector apart = (b.centre - a.centre).normalized() * -found.separation.lower * 1.001L;
    EXPECT_GT(SolidDistance(a, b.Moved(apart)), 0);
  }
  EXPECT_LE(solids, std::max(0.0, found.separation.upper) + tolerance);
  if (found.point_error < 1e300) {
    ++count->points;
    const Vector p = found.p_WC.cast<Real>();
    EXPECT_LE(a.DistanceTo(p), found.point_error + tolerance);
    EXPECT_LE(b.DistanceTo(p), found.point_error + tolerance);
  }
}

void CheckVerdict(const Scene& scene, const ShapeVerdict& verdict, Random& random, Count* count) {
  const SegmentVerdict& times = verdict.times;
  const Real tolerance =
      kOracle * (scene.agents[0].declaration.radius + scene.agents[1].declaration.radius);
  std::vector<Real> instants = {0, scene.duration};
  for (int i = 0; i < 10; ++i) instants.push_back(scene.duration * random.Uniform(0, 1));
  for (const double edge :
       {times.free_until, times.free_from, times.contact_from, times.contact_to}) {
    for (const double off : {-1e-9, 0.0, 1e-9, -1e-3, 1e-3})
      instants.push_back(edge + off * scene.duration);
  }
  for (const Real t : instants) {
    if (!(t >= 0 && t <= scene.duration)) continue;
    if (t < times.free_until || t > times.free_from) {
      EXPECT_GT(scene.Distance(t), 0) << "said to be free at " << static_cast<double>(t);
    }
    const bool edge = t == times.contact_from || t == times.contact_to || times.contact_continuous;
    if (t >= times.contact_from && t <= times.contact_to && edge) {
      EXPECT_LE(scene.Distance(t), tolerance) << "said to touch at " << static_cast<double>(t);
    }
  }
  if (times.free_until == kInfinity)
    ++count->free;
  else if (times.contact_from <= times.contact_to)
    ++count->confirmed;
  else if (times.free_until > 0 || times.free_from < scene.duration)
    ++count->partly_free;
  else
    ++count->undecided;
  if (verdict.looked) CheckNearest(scene, verdict, tolerance, count);
}

Count Judged(std::uint64_t first, int seeds) {
  Count count;
  for (std::uint64_t seed = first;
       seed < first + static_cast<std::uint64_t>(seeds) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = RandomScene(random);
    const BodySegment a = scene.Segment(0), b = scene.Segment(1);
    const SegmentVerdict balls = JudgeSegment(a.ball, b.ball, scene.duration);
    if (balls.free_until == kInfinity) continue;
    Work work(random.Chance(0.5) ? 1000000
                                 : static_cast<std::uint64_t>(random.LogUniform(1, 100000)));
    CheckVerdict(scene, JudgeShapes(a, b, scene.duration, balls, &work), random, &count);
  }
  return count;
}

TEST(ShapePromise, EveryVerdictHoldsForTheTrueMotion) {
  const Count count = Judged(1, 400);
  // Each kind of verdict was there to be held against the truth.
  EXPECT_GT(count.free, 10);
  EXPECT_GT(count.confirmed, 100);
  EXPECT_GT(count.partly_free, 20);
  EXPECT_GT(count.contact, 30);
  EXPECT_GT(count.points, 100);
}

}  // namespace
}  // namespace collision
