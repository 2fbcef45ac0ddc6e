#include "collision_core/shape/outer_hull.h"

#include <gtest/gtest.h>

#include "collision_core/shape/hull_builder.h"
#include "collision_core/shape/shape.h"
#include "tests/collision_core/sphere_tree/meshes.h"
#include "tests/support/random_points.h"
#include "tests/support/truth/exact_convex.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Any direction, an axis, or one at the border of cells.
Vector3f RandomDirection(Random& random) {
  Vector3d n = random.UnitVector();
  const auto axis = static_cast<Eigen::Index>(random.Below(3));
  if (random.Chance(0.1)) n = Vector3d::Unit(axis);
  if (random.Chance(0.3)) {
    n = Vector3d(random.Uniform(-1, 1), static_cast<double>(random.Below(9)) / 4 - 1, 1);
    if (random.Chance(0.5)) n.x() = static_cast<double>(random.Below(9)) / 4 - 1;
    n = Vector3d(n[axis], n[(axis + 1) % 3], n[(axis + 2) % 3]) * (random.Chance(0.5) ? 1 : -1);
  }
  return n.normalized().cast<float>();
}

double MostAlong(const Vector3d& n, const std::vector<Vector3d>& points) {
  double most = -numeric::kInfinity;
  for (const Vector3d& p : points) most = std::max(most, n.dot(p));
  return most;
}

// Goal:   no point, with all that is within the rounding of it, lies beyond what Along() says; of
//         spheres, balls, needles, planes, lines, doubles; from 1e-42 m to a planet's size, at the
//         reference point and far from it.
// Method: all points in turn, exactly.
TEST(OuterHull, NothingReachesFurther) {
  Random random(401);
  for (int i = 0; i < 200; ++i) {
    auto points = RandomPoints(random, 1 + random.Below(i % 3 == 0 ? 40 : 900), i % 5);
    const double size = i % 7 == 0 ? 1e-42 : random.LogUniform(1e-9, 1e7);
    const Vector3d from = random.Chance(0.5) ? size * random.Uniform(0, 1e3) * random.UnitVector()
                                             : Vector3d(0, 0, 0);
    for (Vector3d& p : points) p = size * p + from;
    const double rounding = random.Chance(0.5) ? size * random.Uniform(0, 1) : 0;
    const OuterHull hull(points, rounding);
    for (int k = 0; k < 20; ++k) {
      const Vector3f n = RandomDirection(random);
      const ExactVector exact(n.cast<double>());
      const Exact at_origin = Dot(exact, ExactVector(hull.origin()));
      const Exact allowed = Exact(hull.Along(n).height) + Exact(kHullSupportError * hull.extent()) +
                            at_origin - Exact(rounding * n.cast<double>().norm() * (1 - 0x1p-50));
      for (const Vector3d& p : points) ASSERT_LE(Dot(exact, ExactVector(p)), allowed) << i;
    }
    for (const Vector3d& p : points) EXPECT_LE((p - hull.origin()).norm(), hull.extent());
  }
}

// Goal:   what storing a point in single precision loses is counted in. Along an axis nothing
// else is lost.
TEST(OuterHull, StoredPointsLoseNothing) {
  const double beyond = 1 + 0x1p-25;  // rounded to 1
  const OuterHull hull(std::vector{Vector3d(beyond, 0, 0), Vector3d(-beyond, 0, 0)}, 0);
  for (const float side : {1.0f, -1.0f}) {
    EXPECT_GE(hull.Along(Vector3f(side, 0, 0)).height, beyond);
    EXPECT_LE(hull.Along(Vector3f(side, 0, 0)).height, beyond + 0x1p-20);
  }
}

// Goal:   not much further: a few points are known along most directions exactly, round bodies and
//         needles everywhere to within 5 % of the extent.
TEST(OuterHull, ReachesLittleFurther) {
  Random random(402);
  std::vector<Vector3d> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const std::vector<std::vector<Vector3d>> bodies = {
      RandomPoints(random, 30, 1), cube, RandomPoints(random, 300, 0),
      RandomPoints(random, 5000, 0), RandomPoints(random, 1000, 2)};
  for (const auto& points : bodies) {
    const OuterHull hull(points, 0);
    int exactly = 0;
    for (int k = 0; k < 1000; ++k) {
      const Vector3f n = random.UnitVector().cast<float>();
      const Vector3d along = n.cast<double>();
      const double more =
          hull.Along(n).height + along.dot(hull.origin()) - MostAlong(along, points);
      EXPECT_LE(more, 0.05 * hull.extent());
      exactly += more <= 0.004 * hull.extent();
    }
    if (points.size() < 100) {
      EXPECT_GE(exactly, 900);
    }
    EXPECT_LE(hull.bytes(), std::size_t{24} << 10);
  }
}

// Goal:   the point that Along() returns is one of the foremost.
TEST(OuterHull, TellsThePoint) {
  Random random(403);
  const auto points = RandomPoints(random, 500, 0);
  const OuterHull hull(points, 0);
  for (int k = 0; k < 500; ++k) {
    const Vector3f n = RandomDirection(random);
    const auto answer = hull.Along(n);
    EXPECT_NEAR(n.dot(answer.point), answer.height, 0.05 * hull.extent());
  }
}

ConvexDescription RandomSolid(Random& random) {
  ConvexDescription d;
  using enum geometry::ConvexCore;
  constexpr geometry::ConvexCore kCores[] = {kPoint,    kSegment, kBox, kEllipsoid,
                                             kCylinder, kCone,    kHull};
  d.core = kCores[random.Below(std::size(kCores))];
  const Vector3d half(random.Uniform(0.1, 1), random.Uniform(0.1, 1), random.Uniform(0.1, 1));
  d.half = d.core == geometry::ConvexCore::kSegment ? Vector3d(0, 0, half.z()) : half;
  if (d.core == geometry::ConvexCore::kPoint || d.core == geometry::ConvexCore::kHull)
    d.half = Vector3d(0, 0, 0);
  if (d.core == geometry::ConvexCore::kHull)
    d.points = RandomPoints(random, 4 + random.Below(20), 1);
  const bool is_thin =
      d.core == geometry::ConvexCore::kPoint || d.core == geometry::ConvexCore::kSegment;
  if (is_thin) d.rounding = random.Chance(0.5) ? 0.25 : random.Uniform(0.1, 1);
  if (d.core == geometry::ConvexCore::kBox && random.Chance(0.5)) d.rounding = 0.25;
  if (d.core == kCylinder || d.core == kCone) d.half.y() = d.half.x();
  d.q_BS = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1), 1};
  d.p_BS = random.Uniform(0, 3) * random.UnitVector();
  return d;
}

// Goal:   around solids of all kinds, alike and unlike rounded, alone and with a mesh; and not
//         twice as large.
// Method: the foremost point of each solid, known to kSupportError.
TEST(HullAround, SolidsAndTriangles) {
  Random random(404);
  for (int i = 0; i < 200; ++i) {
    std::vector<ConvexSolid> solids;
    for (std::uint64_t k = 0; k < 1 + random.Below(4); ++k) {
      const ConvexDescription description = RandomSolid(random);
      ASSERT_FALSE(RefusalOf(description)) << *RefusalOf(description);
      solids.push_back(ConvexSolid::Build(description));
    }
    const geometry::TriangleMesh mesh =
        i % 2 == 0 ? geometry::TriangleMesh() : Scaled(Frame(), 0.5);
    const OuterHull hull = HullAround(mesh, solids);
    for (int k = 0; k < 30; ++k) {
      const Vector3f direction = RandomDirection(random);
      const Vector3d n = direction.cast<double>();
      double most = mesh.triangles.empty() ? -numeric::kInfinity : MostAlong(n, mesh.vertices);
      for (const ConvexSolid& solid : solids) {
        const geometry::ConvexSet& set = solid.set();
        const Vector3d foremost = set.centre + set.SupportPoint(n);
        most = std::max(most, n.dot(foremost) + set.rounding * n.norm());
      }
      const double answer = hull.Along(direction).height + n.dot(hull.origin());
      EXPECT_LE(most, answer + kHullSupportError * hull.extent() + 1e-14);
      EXPECT_LE(answer, most + hull.extent());
    }
  }
}

// Goal:   every shape has one, however it was made; vertices of no triangle count for nothing.
TEST(HullAround, OfShapes) {
  geometry::TriangleMesh mesh = Frame();
  const double extent = Shape::Build(mesh)->hull().extent();
  mesh.vertices.emplace_back(100, 100, 100);
  const auto built = Shape::Build(mesh);
  EXPECT_EQ(built->hull().extent(), extent);
  EXPECT_EQ(Shape::FromTree(mesh, built->tree())->hull().extent(), extent);
  ConvexDescription ball;
  ball.rounding = 1, ball.p_BS = {10, 0, 0};
  const auto both = Shape::Compound(Shape::Build(Frame()), {ConvexSolid::Build(ball)});
  const OuterHull& hull = both->hull();
  EXPECT_GE(hull.Along({1, 0, 0}).height + hull.origin().x(), 11 * (1 - 1e-6));
  EXPECT_LE(hull.Along({-1, 0, 0}).height - hull.origin().x(), extent * (1 + 1e-6));
}

}  // namespace
}  // namespace collision::shape
