// Goal:   whatever is said of two shapes over a segment of time holds for every motion within the
//         bounds.
// Method: motions with random and extreme accelerations, in long double; states taken from them
//         before and after the segment; two bodies moved so that they nearly touch within it. Every
//         verdict is held against the true distance: apart where it says apart, together where it
//         says contact, points where they are said to be.
#include <gtest/gtest.h>

#include "collision_core/narrow_phase/contact/shape_contact.h"
#include "tests/collision_core/narrow_phase/promise_scene.h"

namespace collision::narrow_phase {
namespace {

struct Count {
  int free = 0, contact = 0, undecided = 0, partly_free = 0, confirmed = 0, points = 0;
};

// Directions that bodies may leave each other along: between them, and across faces and axes.
std::vector<Vector> WaysOut(const Scene& scene, Real at) {
  std::vector<Vector> ways = {(scene.Body(1, at).centre - scene.Body(0, at).centre).normalized()};
  for (int i = 0; i < 2; ++i) {
    const TruePose pose = scene.agents[i].motion.At(at);
    for (int axis = 0; axis < 3; ++axis) ways.push_back(pose.q * Vector(Vector::Unit(axis)));
    for (const TrueTriangle& t : scene.Body(i, at).triangles) {
      ways.push_back((t[1] - t[0]).cross(t[2] - t[0]).normalized());
    }
  }
  for (std::size_t i = 0, count = ways.size(); i < count; ++i) ways.push_back(-ways[i]);
  return ways;
}

void CheckNearest(const Scene& scene, const ShapeSegmentResult& verdict, Real tolerance,
                  Count* count) {
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
    // But as much as the other bound says does, along some way.
    const Real depth = -found.separation.lower * 1.001L;
    bool leaves = false;
    for (const Vector& way : WaysOut(scene, at)) {
      leaves = leaves || SolidDistance(a, b.Moved(depth * way)) > 0;
    }
    EXPECT_TRUE(leaves) << "depth " << static_cast<double>(depth);
  }
  EXPECT_LE(solids, std::max(0.0, found.separation.upper) + tolerance);
  if (found.point_error < 1e300) {
    ++count->points;
    const Vector p = found.p_WC.cast<Real>();
    EXPECT_LE(a.DistanceTo(p), found.point_error + tolerance);
    EXPECT_LE(b.DistanceTo(p), found.point_error + tolerance);
  }
}

void CheckVerdict(const Scene& scene, const ShapeSegmentResult& verdict, Random& random,
                  Count* count) {
  const SegmentResult& times = verdict.times;
  const Real tolerance = kOracle * (scene.agents[0].limits.radius + scene.agents[1].limits.radius);
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
  if (times.free_until == numeric::kInfinity)
    ++count->free;
  else if (times.contact_from <= times.contact_to)
    ++count->confirmed;
  else if (times.free_until > 0 || times.free_from < scene.duration)
    ++count->partly_free;
  else
    ++count->undecided;
  if (verdict.examined) CheckNearest(scene, verdict, tolerance, count);
}

Count Judged(std::uint64_t first, int seeds) {
  Count count;
  for (std::uint64_t seed = first;
       seed < first + static_cast<std::uint64_t>(seeds) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = RandomScene(random);
    const BodySegment a = scene.Segment(0), b = scene.Segment(1);
    const SegmentResult balls = EvaluateBallSegment(a.ball, b.ball, scene.duration);
    if (balls.free_until == numeric::kInfinity) continue;
    WorkBudget work(random.Chance(0.5) ? 1000000
                                       : static_cast<std::uint64_t>(random.LogUniform(1, 100000)));
    CheckVerdict(scene, EvaluateShapeSegment(a, b, scene.duration, balls, &work), random, &count);
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
}  // namespace collision::narrow_phase
