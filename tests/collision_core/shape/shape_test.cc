// Goal:   signed distances and winding numbers are right, on whichever side they are wrong the safe
// one, and nearly tight.
// Method: exact distances to all triangles; the sum of all solid angles.
#include "collision_core/shape/shape.h"

#include <gtest/gtest.h>

#include "tests/collision_core/geometry/exact_geometry.h"
#include "tests/collision_core/sphere_tree/meshes.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;

geometry::TriangleMesh Nested(bool inner_reversed) {
  const geometry::TriangleMesh inner = Scaled(Sphere(2), 0.5);
  return Joined(Sphere(2), inner_reversed ? Reversed(inner) : inner);
}

std::vector<geometry::TriangleMesh> ClosedMeshes(Random& random) {
  return {Box({-1, -2, -3}, {1, 2, 3}),
          Frame(),
          Sphere(2),
          Star(2, random),
          Tangle(1, random),
          Nested(true),
          Nested(false),
          Reversed(Star(1, random)),
          Joined(Star(1, random), Moved(Frame(), {0.5, 0.25, 0})),
          Moved(Star(1, random), {1e6, 1e6, -1e6})};
}

// What the narrow phase takes from a node: with s >= 0 a point of the surface within s, with s < 0
// a ball of that radius inside the solid.
TEST(Shape, SignedDistancesAreUpperBoundsAndTight) {
  Random random(71);
  for (const geometry::TriangleMesh& mesh : ClosedMeshes(random)) {
    const auto shape = Shape::Build(mesh);
    ASSERT_TRUE(shape->closed());
    const double scale = shape->facts().radius;
    const auto& nodes = shape->tree().nodes;
    for (std::size_t i = 0; i < nodes.size(); i += 1 + random.Below(nodes.size() / 20 + 1)) {
      const sphere_tree::SphereNode& node = nodes[i];
      const Exact exact = SquaredDistance(node.centre, mesh);
      const double s = node.signed_distance;
      const bool is_inside = std::abs(SolidAngleWinding(mesh, node.centre)) > 0.5;
      if (s < 0) {
        ASSERT_TRUE(is_inside);
        ASSERT_LE(Squared(s), exact);
      } else if (s > 1e-12 * scale) {
        // Nearer, the centre is as good as on the surface, and the oracle is not sure.
        ASSERT_FALSE(is_inside);
        ASSERT_GE(Squared(s), exact);
      }
      ASSERT_NEAR(std::abs(s), std::sqrt(double(exact)), 1e-14 * scale);
      ASSERT_LE(s, node.radius);
    }
  }
}

TEST(Shape, OpenSurfacesHaveNoInside) {
  geometry::TriangleMesh mesh = Sphere(3);
  mesh.triangles.pop_back();
  const auto shape = Shape::Build(mesh);
  EXPECT_FALSE(shape->closed());
  for (const sphere_tree::SphereNode& node : shape->tree().nodes)
    EXPECT_GE(node.signed_distance, 0);
}

TEST(Shape, DistancesOfAnyPointContainTheExactOne) {
  Random random(72);
  const geometry::TriangleMesh mesh = Star(2, random);
  const auto shape = Shape::Build(mesh);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = random.LogUniform(1e-6, 100) * random.UnitVector();
    const Exact exact = SquaredDistance(p, mesh);
    const numeric::Interval d = shape->DistanceTo(p);
    ASSERT_LE(Squared(d.lower), exact);
    ASSERT_GE(Squared(d.upper), exact);
    ASSERT_LE(d.width(), 1e-14 * (2 + p.norm()));
  }
  for (const Vector3d& p : mesh.vertices) EXPECT_EQ(shape->DistanceTo(p).upper, 0);
  // Squares of these overflow or vanish.
  EXPECT_TRUE(shape->DistanceTo({1e200, 0, 0}).Contains(1e200));
  EXPECT_TRUE(shape->DistanceTo({1.7e308, 1.7e308, 0}).upper > 1e308);
  const numeric::Interval near = shape->DistanceTo({1e-300, 0, 0}),
                          at = shape->DistanceTo({0, 0, 0});
  EXPECT_NEAR(near.upper, at.upper, 1e-15);
}

/// Where the oracle is sure.
void ExpectWinding(const Shape& shape, const Vector3d& p, int* sure, int* unknown) {
  const auto winding = shape.WindingNumberAt(p);
  const numeric::Interval distance = shape.DistanceTo(p);
  if (!winding) {
    // Exact signs: unknown means on the surface, as far as rounding lets one see.
    EXPECT_EQ(distance.lower, 0);
    ++*unknown;
    return;
  }
  if (distance.upper < 1e-9 * shape.facts().radius) return;
  EXPECT_EQ(double(*winding), std::round(SolidAngleWinding(shape.mesh(), p))) << p.transpose();
  ++*sure;
}

TEST(Shape, WindingNumbersAreTheSumOfSolidAngles) {
  Random random(73);
  for (const geometry::TriangleMesh& mesh : ClosedMeshes(random)) {
    const auto shape = Shape::Build(mesh);
    int sure = 0, unknown = 0;
    for (int i = 0; i < 400; ++i) {
      const geometry::MeshFacts& facts = shape->facts();
      Vector3d p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = random.Uniform(facts.lower[axis], facts.upper[axis]);
      // In line with vertices and edges along all axes: rays meet them exactly.
      if (random.Chance(0.5)) p.y() = mesh.vertices[random.Below(mesh.vertices.size())].y();
      if (random.Chance(0.5)) p.z() = mesh.vertices[random.Below(mesh.vertices.size())].z();
      ExpectWinding(*shape, p, &sure, &unknown);
    }
    EXPECT_GT(sure, 100);
  }
}

// Whole numbers: every ray runs along faces, through edges and corners.
TEST(Shape, WindingOnAGridOfAFrame) {
  const auto shape = Shape::Build(Frame());
  for (double x = -2.5; x <= 2.5; x += 0.25) {
    for (double y = -2.5; y <= 2.5; y += 0.25) {
      for (double z = -1.25; z <= 1.25; z += 0.25) {
        const double ring = std::max(std::abs(x), std::abs(y));
        const bool inside = ring > 1 && ring < 2 && std::abs(z) < 1;
        const bool outside = ring < 1 || ring > 2 || std::abs(z) > 1;
        const auto winding = shape->WindingNumberAt({x, y, z});
        if (inside || outside) {
          ASSERT_EQ(winding, std::optional(inside ? 1 : 0)) << x << " " << y << " " << z;
        } else {
          ASSERT_EQ(winding, std::nullopt) << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(Shape, NestedSurfaces) {
  const auto hollow = Shape::Build(Nested(true)), twice = Shape::Build(Nested(false));
  EXPECT_EQ(hollow->WindingNumberAt({0, 0, 0}), 0);
  EXPECT_EQ(hollow->WindingNumberAt({0.7, 0, 0.1}), 1);
  EXPECT_EQ(twice->WindingNumberAt({0, 0, 0}), 2);
  EXPECT_EQ(twice->WindingNumberAt({0.7, 0, 0.1}), 1);
  EXPECT_EQ(twice->WindingNumberAt({0, 0, 1.1}), 0);
  EXPECT_EQ(Shape::Build(Reversed(Sphere(1)))->WindingNumberAt({0, 0, 0}), -1);
  EXPECT_EQ(hollow->component_points().size(), 2u);
  // The middle of the hollow one is outside it.
  EXPECT_GT(hollow->tree().root().signed_distance, 0.4);
  EXPECT_LT(twice->tree().root().signed_distance, -0.4);
}

TEST(Shape, PointsOnTheSurfaceAreNeverCalled) {
  Random random(74);
  const geometry::TriangleMesh mesh = Box({0, 0, 0}, {1, 1, 1});
  const auto shape = Shape::Build(mesh);
  for (int i = 0; i < 2000; ++i) {
    Vector3d p(random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1));
    for (int axis = 0; axis < 3; ++axis)
      if (random.Chance(0.3)) p[axis] = random.Chance(0.5) ? 0 : 1;
    const bool is_on = (p.array() == 0).any() || (p.array() == 1).any();
    ASSERT_EQ(shape->WindingNumberAt(p), is_on ? std::nullopt : std::optional(1)) << p.transpose();
    // A single unit in the last place decides.
    p.x() = 1;
    ASSERT_EQ(shape->WindingNumberAt({numeric::NextDown(1), 0.5, 0.25}), 1);
    ASSERT_EQ(shape->WindingNumberAt({numeric::NextUp(1), 0.5, 0.25}), 0);
  }
}

}  // namespace
}  // namespace collision::shape
