// Goal:   the quick builder's trees are what sphere_tree.h says, like those of the others, on any
//         mesh; each triangle stands in one leaf, leaves are full and about as deep, and the first
//         balls are measured.
// Method: proofs by exact arithmetic that share no code with the builder (tree_coverage.h,
//         tree_distances.h); counts.
#include "collision_core/sphere_tree/median_split/median_split_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision_core/shape/shape.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "tests/support/dirty_meshes.h"
#include "tests/support/meshes.h"
#include "tests/support/tree_coverage.h"
#include "tests/support/tree_distances.h"

namespace collision::sphere_tree {
namespace {

ShapeOptions Halved(std::uint32_t leaf = 4) {
  return {.builder = TreeBuilder::kMedianSplit, .triangles_per_leaf = leaf};
}

/// The middle of a long edge is a centre that rounding alone keeps off the surface, and every ray
/// that the proof tries meets that edge: there it cannot tell inside from outside, and is not
/// asked.
SphereTree WithoutCentresOnEdges(SphereTree tree, const geometry::TriangleMesh& mesh,
                                 std::size_t* left_out) {
  const double reach = FactsOf(mesh).radius;
  const DistanceProof proof(mesh);
  for (SphereNode& node : tree.nodes) {
    // Minus zero: on the surface, or inside by less than can be told.
    if (!std::signbit(node.signed_distance) || node.signed_distance < -1e-15 * reach) continue;
    if (proof.ComesWithin(node.centre, 0, false)) continue;
    node.signed_distance = node.radius;
    ++*left_out;
  }
  return tree;
}

TEST(MedianSplitBuilder, DirtyMeshesAreCoveredAndMeasured) {
  DyadicPool::Install();
  Random random(601);
  int seen = 0;
  std::size_t nodes = 0, on_edges = 0;
  for (std::uint32_t i = 0; i < 6 * kDirtKinds; ++i) {
    const geometry::TriangleMesh mesh = DirtyMesh(i, random);
    if (mesh.triangles.empty() || RefusalOf(mesh, 100000)) continue;
    SCOPED_TRACE(i);
    ShapeOptions options = Halved(static_cast<std::uint32_t>(random.Below(9)));
    if (random.Chance(0.2)) options.levels_max = static_cast<std::uint32_t>(random.Below(4));
    if (random.Chance(0.2)) options.nodes_max = 1 + random.Below(60);
    const SphereTree tree = shape::Shape::Build(mesh, options)->tree();
    ASSERT_EQ(RefusalOf(tree, mesh), std::nullopt);
    ASSERT_LE(tree.nodes.size(), options.nodes_max);
    ASSERT_LE(tree.levels, options.levels_max + 1);
    ASSERT_EQ(TreeCoverage(mesh, tree).Unproven(), 0u);
    ASSERT_EQ(UnprovenDistances(mesh, WithoutCentresOnEdges(tree, mesh, &on_edges)), 0u);
    nodes += tree.nodes.size();
    ++seen;
  }
  EXPECT_GT(seen, 50);
  EXPECT_LT(on_edges, nodes / 100);
}

TEST(MedianSplitBuilder, LeavesAreFullAndAboutAsDeep) {
  Random random(602);
  for (const std::uint32_t leaf : {1u, 4u, 7u}) {
    for (int times = 0; times <= 4; ++times) {
      const geometry::TriangleMesh mesh = Star(times, random);
      const SphereTree tree = BuildMedianSplit(mesh, Halved(leaf));
      EXPECT_EQ(tree.elements.size(), mesh.triangles.size());
      std::vector<ElementIndex> triangles = tree.elements;
      std::sort(triangles.begin(), triangles.end());
      EXPECT_EQ(std::unique(triangles.begin(), triangles.end()), triangles.end());
      std::size_t leaves = 0;
      std::uint32_t shallowest = tree.levels;
      for (const SphereNode& node : tree.nodes) {
        if (node.children > 0) continue;
        ++leaves;
        EXPECT_LE(node.elements, leaf);
        shallowest = std::min(shallowest, node.level);
      }
      EXPECT_LE(leaves, mesh.triangles.size() / leaf + 1 + mesh.triangles.size() / (4 * leaf));
      EXPECT_GE(shallowest + 3, tree.levels);
    }
  }
}

// All at one place: there is nothing to divide by, and yet it ends.
TEST(MedianSplitBuilder, CopiesUponEachOther) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(1000, {0, 1, 2});
  const SphereTree tree = BuildMedianSplit(mesh, Halved());
  EXPECT_EQ(RefusalOf(tree, mesh), std::nullopt);
  EXPECT_EQ(tree.elements.size(), 1000u);
}

// Its first balls tell of the inside, as those of other builders do; the others are never said to
// be nearer than they may be.
TEST(MedianSplitBuilder, TheFirstBallsAreMeasured) {
  Random random(603);
  const geometry::TriangleMesh mesh = Star(4, random);
  const auto shape = shape::Shape::Build(mesh, Halved(1));
  const auto& nodes = shape->tree().nodes;
  ASSERT_GT(nodes.size(), 1200u);
  EXPECT_LT(nodes[0].signed_distance, 0);
  int inside = 0;
  for (std::size_t i = 0; i < 1024; ++i) inside += nodes[i].signed_distance < 0;
  EXPECT_GT(inside, 100);
  for (std::size_t i = 1024; i < nodes.size(); ++i) {
    EXPECT_EQ(nodes[i].signed_distance, nodes[i].radius);
  }
}

}  // namespace
}  // namespace collision::sphere_tree
