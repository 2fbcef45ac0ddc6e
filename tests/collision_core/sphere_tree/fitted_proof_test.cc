// Goal:   the trees of both builders are what sphere_tree.h says: their balls cover the surface on
// every cut, their signed distances are upper bounds, on real meshes and on dirty ones.
// Method: proofs by exact arithmetic that share no code with the builders (tree_coverage.h,
// tree_distances.h); and that the proofs fail where something is wrong.
#include <gtest/gtest.h>

#include <set>

#include "collision_core/shape/shape.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "tests/support/dirty_meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/tree_coverage.h"
#include "tests/support/tree_distances.h"

namespace collision::sphere_tree {
namespace {

constexpr int kDirtyMeshes = kSanitized ? 4 * kDirtKinds : 24 * kDirtKinds;

/// One of few and small options, often the defaults.
ShapeOptions SomeOptions(TreeBuilder builder, Random& random) {
  ShapeOptions options;
  options.builder = builder;
  if (random.Chance(0.3)) {
    options.triangles_per_leaf = 1 + static_cast<std::uint32_t>(random.Below(8));
  }
  if (random.Chance(0.2)) options.levels_max = static_cast<std::uint32_t>(random.Below(6));
  // Copies upon each other are taken apart in vain by octants: not too often.
  const bool is_octree = builder == TreeBuilder::kOctree;
  if (is_octree || random.Chance(0.2)) options.nodes_max = 1 + random.Below(400);
  return options;
}

void ExpectProven(const geometry::TriangleMesh& mesh, const ShapeOptions& options) {
  const auto shape = shape::Shape::Build(mesh, options);
  const SphereTree& tree = shape->tree();
  ASSERT_EQ(RefusalOf(tree, mesh), std::nullopt);
  ASSERT_LE(tree.nodes.size(), options.nodes_max);
  ASSERT_LE(tree.levels, options.levels_max + 1);
  ASSERT_EQ(TreeCoverage(mesh, tree).Unproven(), 0u);
  ASSERT_EQ(UnprovenDistances(mesh, tree), 0u);
}

TEST(FittedProof, DirtyMeshesAreCoveredAndMeasured) {
  DyadicPool::Install();
  Random random(501);
  int closed = 0;
  for (std::uint32_t i = 0; i < kDirtyMeshes; ++i) {
    const geometry::TriangleMesh mesh = DirtyMesh(i, random);
    if (mesh.triangles.empty() || RefusalOf(mesh, 100000)) continue;
    closed += FactsOf(mesh).closed;
    SCOPED_TRACE(i);
    ExpectProven(mesh, SomeOptions(TreeBuilder::kFitted, random));
    if (i % 4 == 0) ExpectProven(mesh, SomeOptions(TreeBuilder::kOctree, random));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(closed, kDirtyMeshes / 5);
  EXPECT_LT(closed, kDirtyMeshes * 4 / 5);
}

// What nothing in the tree can hide: a ball that is smaller, a leaf without its triangle, a centre
// that is said to be deeper.
TEST(FittedProof, SeesWhatIsWrong) {
  DyadicPool::Install();
  Random random(503);
  const geometry::TriangleMesh mesh = Star(3, random);
  ShapeOptions options;
  options.builder = TreeBuilder::kFitted;
  const SphereTree tree = shape::Shape::Build(mesh, options)->tree();
  const std::size_t nodes = tree.nodes.size();
  ASSERT_GT(nodes, 50u);
  SphereTree smaller = tree;
  smaller.nodes[0].radius *= 1 - 1e-13;
  EXPECT_GT(TreeCoverage(mesh, smaller).Unproven(60), 0u);
  for (std::size_t i = 0; i < nodes; i += 17) {
    SphereTree deeper = tree;
    deeper.nodes[i].signed_distance -= 1e-2;
    EXPECT_EQ(UnprovenDistances(mesh, deeper), 1u) << "node " << i;
  }
  SphereTree lost = tree;
  std::swap(lost.elements.front(), lost.elements.back());
  EXPECT_GT(TreeCoverage(mesh, lost).Unproven(30), 0u);
  EXPECT_LT(TreeCoverage(mesh, lost).ProvenShare(30), 1);
  EXPECT_EQ(TreeCoverage(mesh, tree).ProvenShare(), 1);
}

// A radius of a leaf with one triangle is as small as its corners allow.
TEST(FittedProof, NoLeafIsLargerThanItsTriangles) {
  Random random(502);
  const geometry::TriangleMesh mesh = Star(3, random);
  ShapeOptions options;
  options.builder = TreeBuilder::kFitted;
  const SphereTree tree = shape::Shape::Build(mesh, options)->tree();
  for (const SphereNode& node : tree.nodes) {
    double most = 0;
    for (const ElementIndex t : tree.ElementsOf(node)) {
      for (const std::uint32_t corner : mesh.triangles[t.value()])
        most = std::max(most, (mesh.vertices[corner] - node.centre).norm());
    }
    ASSERT_TRUE(node.children != 0 || node.radius <= most * (1 + 1e-14));
  }
}

}  // namespace
}  // namespace collision::sphere_tree
