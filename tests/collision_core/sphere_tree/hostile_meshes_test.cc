// Goal:   no mesh makes a tree grow, or its building last, beyond what its number of triangles
//         allows; the tree is one of its mesh all the same, and covers it.
// Method: thousands of triangles that are in each other's way, through every builder; counts, no
//         clocks.
#include <gtest/gtest.h>

#include "collision_core/shape/shape.h"
#include "collision_core/sphere_tree/octree/octree_builder.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "tests/support/dirty_meshes.h"
#include "tests/support/tree_coverage.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

geometry::TriangleMesh Copies(std::size_t count) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(count, {0, 1, 2});
  return mesh;
}

geometry::TriangleMesh CrossingTriangles(std::size_t count, Random& random) {
  geometry::TriangleMesh mesh;
  while (mesh.triangles.size() < count) {
    const Vector3d a = dirt::Point(random, 1), b = dirt::Point(random, 1);
    dirt::AddTriangle(a, b, dirt::Point(random, 1), &mesh);
  }
  return mesh;
}

/// Closed, from anywhere to anywhere.
geometry::TriangleMesh Needles(std::size_t count, Random& random) {
  geometry::TriangleMesh mesh;
  while (mesh.triangles.size() < count) {
    const Vector3d a = dirt::Point(random, 1), b = dirt::Point(random, 1);
    dirt::AddTetrahedron(a, b, a + 1e-4 * random.UnitVector(), b + 1e-4 * random.UnitVector(),
                         &mesh);
  }
  return mesh;
}

geometry::TriangleMesh NeedlesFromOneCorner(std::size_t count, Random& random) {
  geometry::TriangleMesh mesh;
  while (mesh.triangles.size() < count) {
    const Vector3d p = random.UnitVector();
    dirt::AddTriangle({0, 0, 0}, p, p + 1e-4 * random.UnitVector(), &mesh);
  }
  return mesh;
}

std::size_t Measured(const SphereTree& tree) {
  std::size_t measured = 0;
  for (const SphereNode& node : tree.nodes) measured += node.signed_distance != node.radius;
  return measured;
}

TEST(HostileMeshes, TreesOfThemAreBounded) {
  Random random(801);
  const geometry::TriangleMesh meshes[] = {Copies(2000), CrossingTriangles(2000, random),
                                           Needles(2000, random),
                                           NeedlesFromOneCorner(2000, random)};
  for (const geometry::TriangleMesh& mesh : meshes) {
    for (const TreeBuilder builder :
         {TreeBuilder::kOctree, TreeBuilder::kFitted, TreeBuilder::kMedianSplit}) {
      const SphereTree tree = shape::Shape::Build(mesh, {.builder = builder})->tree();
      EXPECT_EQ(RefusalOf(tree, mesh), std::nullopt);
      EXPECT_LE(tree.elements.size(), PiecesMax(mesh.triangles.size()));
    }
  }
}

// The bound is not idle: three more levels would break it. Where it ends a node, the part is still
// covered.
TEST(HostileMeshes, OctreesGrowUpToTheBound) {
  DyadicPool::Install();
  Random random(802);
  for (const std::size_t count : {100, 300}) {
    const geometry::TriangleMesh mesh = CrossingTriangles(count, random);
    const SphereTree tree = BuildOctree(mesh, {.triangles_per_leaf = 1});
    EXPECT_LE(tree.elements.size(), PiecesMax(count));
    EXPECT_GE(tree.elements.size(), PiecesMax(count) / 2);
    EXPECT_EQ(TreeCoverage(mesh, tree).Unproven(), 0u);
  }
}

// Every ball about copies is as far from all of them.
TEST(HostileMeshes, QuickTreesMeasureWhatTheyCanAfford) {
  const std::size_t count = 20'000;
  const auto tree =
      shape::Shape::Build(Copies(count), {.builder = TreeBuilder::kMedianSplit})->tree();
  EXPECT_GE(Measured(tree), 10u);
  EXPECT_LE(Measured(tree), 1024 * 1024 / count + 1);
}

// Balls that were not measured come last, and not among meshes as they should be.
TEST(HostileMeshes, FittedTreesSearchAsLongAsThereIsWorkLeft) {
  Random random(803);
  const auto needles =
      shape::Shape::Build(Needles(4000, random), {.builder = TreeBuilder::kFitted});
  const auto& nodes = needles->tree().nodes;
  std::size_t first = 0;
  while (first < nodes.size() && nodes[first].signed_distance != nodes[first].radius) ++first;
  EXPECT_GT(first, 64u);
  EXPECT_LT(Measured(needles->tree()), nodes.size() / 2);
  const auto star = shape::Shape::Build(Star(3, random), {.builder = TreeBuilder::kFitted});
  EXPECT_EQ(Measured(star->tree()), star->tree().nodes.size());
}

}  // namespace
}  // namespace collision::sphere_tree
