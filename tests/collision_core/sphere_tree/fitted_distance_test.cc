// Goal:   signed distances are upper bounds although they come from a search that may be wrong, and
// not loose.
// Method: exact rational arithmetic over all triangles (DistanceProof), near needles, which a
// search in plain doubles measures wrongly.
#include "collision_core/sphere_tree/fitted/fitted_distance.h"

#include <gtest/gtest.h>

#include "tests/support/dirty_meshes.h"
#include "tests/support/tree_distances.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// Closed: a cube, in it needles with two sides, which enclose nothing.
geometry::TriangleMesh CubeWithNeedles(Random& random) {
  geometry::TriangleMesh mesh = Cube(1);
  for (int i = 0; i < 6; ++i) {
    geometry::TriangleMesh needle;
    const Vector3d a = dirt::Point(random, 0.7), b = dirt::Point(random, 0.7);
    const double off = random.LogUniform(1e-16, 1e-6);
    dirt::AddTriangle(a, b, a + random.Uniform(0, 1) * (b - a) + off * random.UnitVector(),
                      &needle);
    if (DropDegenerate(&needle) > 0) continue;
    mesh = Joined(Joined(mesh, needle), Reversed(needle));
  }
  return mesh;
}

TEST(FittedDistance, IsAnUpperBoundAndTight) {
  Random random(521);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const geometry::TriangleMesh mesh = CubeWithNeedles(random);
    ASSERT_TRUE(FactsOf(mesh).closed);
    const TriangleBoxTree boxes(mesh);
    const FittedDistance distance(boxes, SurfaceKind::kClosed);
    const DistanceProof proof(mesh);
    for (int k = 0; k < 20; ++k) {
      const Vector3d c = dirt::Point(random, 1.1);
      const double slack = random.Chance(0.5) ? 0 : random.LogUniform(1e-12, 0.1);
      const ElementIndex hint(random.Below(mesh.triangles.size()));
      const CentreFacts facts = distance.Certify(c, slack, {}, hint);
      const double s = facts.signed_distance;
      ASSERT_EQ(facts.inside, s < 0);
      if (s < 0) {
        ++inside;
        ASSERT_LT(c.cwiseAbs().maxCoeff(), 1);
        ASSERT_FALSE(proof.ComesWithin(c, -s, true)) << i << " " << k;
        ASSERT_TRUE(proof.ComesWithin(c, -s + slack + 1e-11, false)) << i << " " << k;
      } else {
        ASSERT_TRUE(proof.ComesWithin(c, s, false));
        ASSERT_FALSE(proof.ComesWithin(c, s - slack - 1e-11, false));
        ASSERT_TRUE(c.cwiseAbs().maxCoeff() > 1 || s < slack + 1e-12);
      }
    }
  }
  EXPECT_GT(inside, 3000);
}

// Every triangle within the limit is visited, also one at the limit exactly; and few others are.
// Faces of a cube lie in their boxes' faces: there box and triangle are equally far.
TEST(TriangleBoxTree, VisitsWhatIsWithinTheLimit) {
  Random random(522);
  const geometry::TriangleMesh mesh = Subdivided(Cube(1), 3);
  const TriangleBoxTree boxes(mesh);
  std::size_t visits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = dirt::Point(random, 3);
    const ElementIndex triangle(random.Below(mesh.triangles.size()));
    const double limit = geometry::DistanceToTriangle(p, boxes.CornersOf(triangle)).distance.upper;
    const NearPoint near = boxes.Nearest(p, triangle, 0, 0);
    ASSERT_LE(near.distance, limit * (1 + 1e-15));
    bool is_visited = false;
    boxes.VisitWithin(p, &limit, [&](ElementIndex t) { is_visited = is_visited || t == triangle; });
    ASSERT_TRUE(is_visited);
    const double nearest =
        geometry::DistanceToTriangle(p, boxes.CornersOf(near.triangle)).distance.upper;
    is_visited = false;
    boxes.VisitWithin(p, &nearest, [&](ElementIndex t) {
      ++visits;
      is_visited = is_visited || t == near.triangle;
    });
    ASSERT_TRUE(is_visited);
  }
  EXPECT_LT(visits, 1000u * 40u);
}

// A centre near by that is inside says so of another only within the ball that it knows.
TEST(FittedDistance, TakesAnothersWordOnlyInItsBall) {
  const geometry::TriangleMesh mesh = Joined(Cube(1), Moved(Cube(1), {4, 0, 0}));
  const TriangleBoxTree boxes(mesh);
  const FittedDistance distance(boxes, SurfaceKind::kClosed);
  const CentreFacts middle = distance.Certify({0, 0, 0}, 0, {}, ElementIndex(0u));
  ASSERT_TRUE(middle.inside);
  EXPECT_NEAR(middle.signed_distance, -1, 1e-11);
  EXPECT_TRUE(distance.Certify({0.5, 0.5, 0.5}, 0, middle, ElementIndex(0u)).inside);
  EXPECT_FALSE(distance.Certify({1.001, 0, 0}, 0, middle, ElementIndex(0u)).inside);
  EXPECT_FALSE(distance.Certify({2, 0, 0}, 0, middle, ElementIndex(0u)).inside);
  EXPECT_TRUE(distance.Certify({4, 0.5, 0}, 0, middle, ElementIndex(0u)).inside);
}

// Without an inside there is none.
TEST(FittedDistance, OpenSurfacesHaveNoInside) {
  geometry::TriangleMesh mesh = Cube(1);
  mesh.triangles.pop_back();
  const TriangleBoxTree boxes(mesh);
  const CentreFacts facts =
      FittedDistance(boxes, SurfaceKind::kOpen).Certify({0, 0, 0}, 0, {}, ElementIndex(0u));
  EXPECT_FALSE(facts.inside);
  EXPECT_NEAR(facts.signed_distance, 1, 1e-11);
}

}  // namespace
}  // namespace collision::sphere_tree
