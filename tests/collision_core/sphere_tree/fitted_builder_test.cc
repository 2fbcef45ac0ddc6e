// Goal:   the fitted tree keeps its form and its limits whatever the mesh, makes the same bits
// again, and is tight where geometry says how tight it can be. Method: counts and closed answers;
// coverage by proof (tree_coverage.h).
#include "collision_core/sphere_tree/fitted/fitted_builder.h"

#include <gtest/gtest.h>

#include "collision_core/sphere_tree/fitted/fitted_pieces.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "collision_core/sphere_tree/tree_cut.h"
#include "tests/support/dirty_meshes.h"
#include "tests/support/tree_coverage.h"
#include "tests/support/tree_distances.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

SphereTree Build(const geometry::TriangleMesh& mesh, const ShapeOptions& options = {}) {
  return BuildFitted(mesh, options,
                     FactsOf(mesh).closed ? SurfaceKind::kClosed : SurfaceKind::kOpen);
}

void ExpectProven(const geometry::TriangleMesh& mesh, const SphereTree& tree) {
  DyadicPool::Install();
  ASSERT_EQ(RefusalOf(tree, mesh), std::nullopt);
  ASSERT_EQ(TreeCoverage(mesh, tree).Unproven(), 0u);
  ASSERT_EQ(UnprovenDistances(mesh, tree), 0u);
}

/// What may stand between a node and the surface, largest of all leaves'.
double WorstLeaf(const SphereTree& tree) {
  double worst = 0;
  for (const SphereNode& node : tree.nodes) {
    if (node.children == 0) worst = std::max(worst, node.radius + node.signed_distance);
  }
  return worst;
}

TEST(FittedBuilder, SameInputGivesTheSameBits) {
  Random random(511);
  const geometry::TriangleMesh mesh = Star(3, random);
  const SphereTree a = Build(mesh), b = Build(mesh);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  EXPECT_EQ(a.elements, b.elements);
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    ASSERT_EQ(a.nodes[i].centre, b.nodes[i].centre);
    ASSERT_EQ(a.nodes[i].radius, b.nodes[i].radius);
    ASSERT_EQ(a.nodes[i].signed_distance, b.nodes[i].signed_distance);
  }
}

// One ball fits a sphere as well as its facets do: every node has it, at every level. So nothing is
// searched below the root either: no centre is new.
TEST(FittedBuilder, ASphereIsOneBall) {
  const geometry::TriangleMesh mesh = Sphere(5);
  const SphereTree tree = Build(mesh);
  EXPECT_GT(tree.nodes.size(), 2000u);
  for (const SphereNode& node : tree.nodes) {
    ASSERT_LE(node.radius + node.signed_distance, 0.002);
    ASSERT_EQ(node.centre, tree.root().centre);
  }
  ExpectProven(mesh, tree);
}

// A patch of width w of a face overshoots a ball at depth d inside by about w² / 8d, not by w / 2
// as a ball about the patch does: nearly all balls are left for the edges. A length L of an edge
// asks for r + s = 0.354 L at least (centre 0.354 L from both faces), all edges together for 0.354
// · 24.
TEST(FittedBuilder, FlatFacesHaveBallsInside) {
  const geometry::TriangleMesh mesh = Subdivided(Cube(1), 4);
  const SphereTree tree = Build(mesh);
  EXPECT_NEAR(tree.root().radius, std::sqrt(3.0), 1e-2);
  EXPECT_NEAR(tree.root().signed_distance, -1, 1e-2);
  const auto cut = CutOfCount(tree, 200);
  EXPECT_GT(cut.size(), 190u);
  const double least = 0.354 * 24 / 200;
  EXPECT_LE(OvershootOf(tree, cut).mean, 2.5 * least);
}

TEST(FittedBuilder, KeepsItsLimits) {
  Random random(512);
  const geometry::TriangleMesh mesh = Star(4, random);
  for (const std::uint32_t per_leaf : {1u, 4u, 16u}) {
    ShapeOptions options;
    options.triangles_per_leaf = per_leaf;
    const SphereTree tree = Build(mesh, options);
    EXPECT_LT(tree.levels, options.levels_max + 1);
    for (const SphereNode& node : tree.nodes) ASSERT_LE(node.elements, per_leaf);
  }
  ShapeOptions flat;
  flat.levels_max = 0;
  EXPECT_EQ(Build(mesh, flat).nodes.size(), 1u);
  EXPECT_EQ(Build(mesh, flat).root().elements, mesh.triangles.size());
  for (const std::size_t nodes_max : {1u, 8u, 9u, 100u, 1000u}) {
    ShapeOptions few;
    few.nodes_max = nodes_max;
    const SphereTree tree = Build(mesh, few);
    EXPECT_LE(tree.nodes.size(), nodes_max);
    EXPECT_GE(tree.nodes.size() + 8, std::min<std::size_t>(nodes_max, 1000));
    ExpectProven(mesh, tree);
  }
  ShapeOptions shallow;
  shallow.levels_max = 3;
  const SphereTree tree = Build(mesh, shallow);
  // 2,048 triangles in three divisions by eight, no worse shared out than need be.
  for (const SphereNode& node : tree.nodes) ASSERT_LE(node.elements, 64u);
  ExpectProven(mesh, tree);
}

// No division takes apart what meets in one corner, or lies upon each other: neither runs away.
TEST(FittedBuilder, FansAndCopiesEnd) {
  Random random(513);
  geometry::TriangleMesh fan = {{{0, 0, 0}}, {}};
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Vector3d p = random.UnitVector();
    fan.vertices.insert(fan.vertices.end(), {p, p + 0.01 * random.UnitVector()});
    fan.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  geometry::TriangleMesh copies = Box({0, 0, 0}, {1, 1, 1});
  for (int i = 0; i < 6; ++i) copies = Joined(copies, copies);
  for (const geometry::TriangleMesh& mesh : {fan, copies}) {
    const SphereTree tree = Build(mesh);
    EXPECT_LT(tree.nodes.size(), 6 * mesh.triangles.size());
    EXPECT_LT(tree.elements.size(), 4 * mesh.triangles.size() + 1000);
    for (const SphereNode& node : tree.nodes) ASSERT_LE(node.elements, 4u);
    ExpectProven(mesh, tree);
  }
}

// Goal:   large triangles among small ones are halved, and what rounding does to the corners is in
// the radii: without kHalvingError this fails.
// Method: far from the origin, where coordinates are rounded by 1e-9 and middles of edges with
// them.
TEST(FittedBuilder, HalvedTrianglesAreCoveredFarFromTheOrigin) {
  Random random(514);
  for (int i = 0; i < 20; ++i) {
    const Vector3d corner(9e6, -8e6, 7e6);
    geometry::TriangleMesh mesh;
    for (int k = 0; k < 30; ++k) {
      dirt::AddTriangle(corner + random.UnitVector(), corner + random.UnitVector(),
                        corner + random.UnitVector(), &mesh);
    }
    const SphereTree tree = Build(mesh);
    EXPECT_GT(tree.elements.size(), mesh.triangles.size());
    ExpectProven(mesh, tree);
  }
}

TEST(FittedPieces, HalvesAreExactUpToTheStatedError) {
  Random random(515);
  geometry::TriangleMesh mesh;
  dirt::AddTriangle({1 / 3.0, 5e6, 1}, {7, 5e6 + 1 / 3.0, -1}, {-2, 5e6 - 1, 1 / 7.0}, &mesh);
  FittedPieces pieces(mesh);
  // Exact corners beside those that are stored.
  std::vector<ExactVector> exact;
  for (const Vector3d& p : mesh.vertices) exact.push_back(ExactVector(p));
  for (int i = 0; i < 300; ++i) {
    const auto which = static_cast<std::uint32_t>(random.Below(pieces.size()));
    const std::array<std::uint32_t, 3> before = pieces[which].corners;
    const std::uint32_t second = pieces.Halve(which);
    const auto middle = static_cast<std::uint32_t>(pieces.points() - 1);
    std::vector<std::uint32_t> ends;
    for (const std::uint32_t c : before) {
      const auto has = [c](const FittedPiece& piece) {
        return std::find(piece.corners.begin(), piece.corners.end(), c) != piece.corners.end();
      };
      if (has(pieces[which]) != has(pieces[second])) ends.push_back(c);
    }
    ASSERT_EQ(ends.size(), 2u);
    exact.push_back(Exact(1, 2) * (exact[ends[0]] + exact[ends[1]]));
    const Exact off = Square(ExactVector(pieces.PointAt(middle)) - exact.back());
    const double stated = pieces.ErrorAt(middle);
    ASSERT_LE(off, Exact(stated) * Exact(stated));
    ASSERT_LE(stated, 1e-13 * 5e6);
  }
}

// The size of a mesh changes nothing but the size of its tree.
TEST(FittedBuilder, DoesNotDependOnTheScale) {
  Random random(516);
  const geometry::TriangleMesh mesh = Star(3, random);
  const SphereTree tree = Build(mesh);
  for (const double by : {0x1p-18, 0x1p+20}) {
    const SphereTree other = Build(Scaled(mesh, by));
    ASSERT_EQ(other.nodes.size(), tree.nodes.size());
    EXPECT_EQ(other.elements, tree.elements);
    EXPECT_NEAR(WorstLeaf(other) / by, WorstLeaf(tree), 1e-9);
  }
}

}  // namespace
}  // namespace collision::sphere_tree
