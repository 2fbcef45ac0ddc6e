// Goal:   nodes cover the surface: parts unite, balls contain their parts, every level is a cut.
// Method: points of the surface in exact rational arithmetic, with no allowance; each must lead
// from the root to a leaf that lists its triangle, through balls that contain it.
#include "collision_core/sphere_tree/octree/octree_builder.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/collision_core/geometry/exact_geometry.h"
#include "tests/collision_core/sphere_tree/meshes.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// In doubles where these decide by far, else exactly.
bool BallContains(const SphereNode& node, const ExactPoint& p) {
  const Vector3d near(p[0].convert_to<double>(), p[1].convert_to<double>(),
                      p[2].convert_to<double>());
  const double excess = (near - node.centre).norm() - node.radius;
  if (std::abs(excess) > 1e-14 * (near.norm() + node.radius)) return excess < 0;
  const ExactPoint d = p - ExactOf(node.centre);
  return DotOf(d, d) <= Squared(node.radius);
}

/// Is there a way down on which every ball contains the point, to a leaf that lists its triangle?
/// If so, the nodes of every cut contain it, and children what their parents have.
bool IsCovered(const SphereTree& tree, const SphereNode& node, const ExactPoint& p,
               std::uint32_t triangle) {
  if (!BallContains(node, p)) return false;
  for (const SphereNode& child : tree.ChildrenOf(node)) {
    if (IsCovered(tree, child, p, triangle)) return true;
  }
  const auto listed = tree.ElementsOf(node);
  return std::find(listed.begin(), listed.end(), ElementIndex(triangle)) != listed.end();
}

/// On the triangle, exactly; often on its sides and at its corners.
ExactPoint PointOf(const ExactTriangle& t, Random& random) {
  const Exact a(random.Below(5)), b(random.Below(1000)), c(1 + random.Below(1000));
  const ExactPoint p = Along(t[0], b / (a + b + c), t[1] - t[0]);
  return Along(p, c / (a + b + c), t[2] - t[0]);
}

/// Every link and count of the tree is in order.
void ExpectWellFormed(const SphereTree& tree, const geometry::TriangleMesh& mesh,
                      const ShapeOptions& options) {
  ASSERT_FALSE(tree.nodes.empty());
  EXPECT_LE(tree.nodes.size(), options.nodes_max);
  EXPECT_LE(tree.levels, options.levels_max + 1);
  EXPECT_EQ(tree.levels, tree.nodes.back().level + 1);
  std::uint32_t next_child = 1, next_triangle = 0;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const SphereNode& node = tree.nodes[i];
    ASSERT_TRUE(i == 0 || node.level >= tree.nodes[i - 1].level);
    ASSERT_EQ(node.children == 0, node.elements != 0);
    ASSERT_NE(node.children, 1u);
    ASSERT_TRUE(std::isfinite(node.radius));
    if (node.children == 0) {
      ASSERT_EQ(node.first_element, next_triangle);
      next_triangle += node.elements;
      const auto list = tree.ElementsOf(node);
      ASSERT_EQ(std::set(list.begin(), list.end()).size(), list.size());
    } else {
      ASSERT_EQ(node.first_child, next_child);
      next_child += node.children;
      for (const SphereNode& child : tree.ChildrenOf(node)) ASSERT_EQ(child.level, node.level + 1);
    }
  }
  EXPECT_EQ(next_child, tree.nodes.size());
  EXPECT_EQ(next_triangle, tree.elements.size());
  const std::set<ElementIndex> all(tree.elements.begin(), tree.elements.end());
  EXPECT_EQ(all.size(), mesh.triangles.size());
}

void ExpectCovered(const geometry::TriangleMesh& mesh, const ShapeOptions& options, int points,
                   Random& random) {
  const SphereTree tree = BuildOctree(mesh, options);
  ExpectWellFormed(tree, mesh, options);
  for (int i = 0; i < points; ++i) {
    const auto triangle = static_cast<std::uint32_t>(random.Below(mesh.triangles.size()));
    const ExactPoint p = PointOf(ExactOf(mesh, mesh.triangles[triangle]), random);
    ASSERT_TRUE(IsCovered(tree, tree.root(), p, triangle)) << "point " << i;
  }
}

/// Meshes of every kind, some far from the origin, where rounding is worst.
std::vector<geometry::TriangleMesh> Meshes(Random& random) {
  geometry::TriangleMesh single, duplicates = Box({0, 0, 0}, {1, 2, 3}), plane, slivers;
  single.vertices = {{0, 0, 0}, {1, 2, 3}, {4, -1, 2}};
  single.triangles = {{0, 1, 2}};
  for (int i = 0; i < 3; ++i) duplicates = Joined(duplicates, duplicates);
  plane = Box({-1, -1, 0.25}, {1, 1, 5});
  plane.triangles.resize(2);
  plane = Subdivided(plane, 4);
  for (int i = 0; i < 200; ++i) {
    const auto first = static_cast<std::uint32_t>(slivers.vertices.size());
    const Vector3d a = random.UnitVector(), b = random.UnitVector();
    slivers.vertices.insert(slivers.vertices.end(),
                            {a, b, 0.5 * (a + b) + 1e-14 * random.UnitVector()});
    slivers.triangles.push_back({first, first + 1, first + 2});
  }
  return {single,
          duplicates,
          plane,
          slivers,
          Frame(),
          Sphere(4),
          Star(3, random),
          Tangle(2, random),
          Moved(Star(3, random), {9e6, -8e6, 7e6}),
          Moved(Scaled(Star(2, random), 1e-6), {1, 1, 1}),
          Scaled(Star(2, random), 1e6)};
}

TEST(Octree, EveryPointOfTheSurfaceIsCoveredOnEveryCut) {
  Random random(61);
  for (const geometry::TriangleMesh& mesh : Meshes(random)) ExpectCovered(mesh, {}, 300, random);
  ShapeOptions deep;
  deep.triangles_per_leaf = 1;
  deep.levels_max = 6;
  for (const geometry::TriangleMesh& mesh : Meshes(random)) ExpectCovered(mesh, deep, 100, random);
}

// Goal:   the rounding of cuts is in the radii: without kCutError this fails.
// Method: nine million metres from the origin coordinates are rounded by 1e-9. The rim of a plate
// rises by a few such steps, so that the corners where it is cut are rounded, often inward; balls
// of square pieces pass through them, and nothing else covers the rim.
TEST(Octree, TheRimOfAPlateIsCoveredWhereItIsCut) {
  Random random(62);
  ShapeOptions options;
  options.triangles_per_leaf = 1;
  options.levels_max = 6;
  for (int i = 0; i < 20; ++i) {
    const double step = 0x1p-29, rise = step * double(1 + random.Below(9));
    const Vector3d corner(9e6, 9e6, 9e6);
    geometry::TriangleMesh plate = {{corner, corner + Vector3d(1, 0, 0),
                                     corner + Vector3d(1, 1 + rise, 0), corner + Vector3d(0, 1, 0)},
                                    {{0, 1, 2}, {0, 2, 3}}};
    // More at one place than a leaf or a fan may have: divided down to the last level.
    for (int copy = 0; copy < 3; ++copy) plate = Joined(plate, plate);
    const SphereTree tree = BuildOctree(plate, options);
    const ExactPoint from = ExactOf(plate.vertices[3]), edge = ExactOf(plate.vertices[2]) - from;
    for (int cell = 1; cell < 64; ++cell) {
      for (const double aside : {0.0, 1e-10, -1e-10, 1e-9, -1e-9}) {
        const Exact s = Exact(cell) / 64 + Exact(aside);
        ASSERT_TRUE(IsCovered(tree, tree.root(), Along(from, s, edge), 1)) << i << " " << cell;
      }
    }
  }
}

TEST(Octree, ACutHasEachWayDownOnce) {
  Random random(63);
  const SphereTree tree = BuildOctree(Star(3, random), {});
  for (std::uint32_t level = 0; level <= tree.levels; ++level) {
    std::vector<int> in_cut(tree.nodes.size(), 0);
    for (const NodeIndex i : tree.Cut(level)) ++in_cut[i.value()];
    // From parents to children: how many of the cut stand on the way down so far.
    for (const SphereNode& node : tree.nodes) {
      const int here = in_cut[static_cast<std::size_t>(&node - tree.nodes.data())];
      for (std::uint32_t i = 0; i < node.children; ++i) in_cut[node.first_child + i] += here;
      ASSERT_TRUE(node.children != 0 || here == 1) << "level " << level;
    }
  }
  EXPECT_EQ(tree.Cut(0), std::vector{SphereTree::kRoot});
  std::size_t leaves = 0;
  for (const SphereNode& node : tree.nodes) leaves += node.children == 0;
  EXPECT_EQ(tree.Cut(tree.levels - 1).size(), leaves);
}

TEST(Octree, BallsAreSmallAndHalveFromLevelToLevel) {
  const geometry::TriangleMesh mesh = Sphere(5);
  const SphereTree tree = BuildOctree(mesh, {});
  EXPECT_LE(tree.root().radius, 1.05);
  std::vector<double> mean;
  for (std::uint32_t level = 0; level < 5; ++level) {
    double sum = 0, most = 0;
    const auto cut = tree.Cut(level);
    for (const NodeIndex i : cut) {
      sum += tree.node(i).radius;
      most = std::max(most, tree.node(i).radius);
    }
    // No larger than the circumscribed ball of its octant, whose edge is 2 / 2^level.
    EXPECT_LE(most, 1.7321 / (1 << level));
    mean.push_back(sum / double(cut.size()));
  }
  // The first division of a sphere takes less: its octants are still nearly as wide.
  for (std::size_t level = 2; level < mean.size(); ++level)
    EXPECT_NEAR(mean[level] / mean[level - 1], 0.5, 0.15) << "level " << level;
}

TEST(Octree, LeavesKeepWhatTheOptionsSay) {
  const geometry::TriangleMesh mesh = Sphere(4);
  for (const std::uint32_t per_leaf : {1u, 4u, 16u}) {
    ShapeOptions options;
    options.triangles_per_leaf = per_leaf;
    const SphereTree tree = BuildOctree(mesh, options);
    for (const SphereNode& node : tree.nodes) EXPECT_LE(node.elements, kFanFactor * per_leaf + 4);
  }
  ShapeOptions flat;
  flat.levels_max = 0;
  EXPECT_EQ(BuildOctree(mesh, flat).nodes.size(), 1u);
  EXPECT_EQ(BuildOctree(mesh, flat).root().elements, mesh.triangles.size());
  Random random(64);
  for (const std::size_t nodes_max : {1u, 8u, 9u, 100u, 1000u}) {
    ShapeOptions few;
    few.nodes_max = nodes_max;
    ExpectCovered(mesh, few, 20, random);
  }
}

// What all triangles of a mesh share no division takes apart: neither may run away.
TEST(Octree, FansAndDuplicatesEnd) {
  Random random(65);
  geometry::TriangleMesh fan = {{{0, 0, 0}}, {}};
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Vector3d p = random.UnitVector();
    fan.vertices.insert(fan.vertices.end(), {p, p + 0.01 * random.UnitVector()});
    fan.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  ExpectCovered(fan, {}, 100, random);
  EXPECT_LT(BuildOctree(fan, {}).nodes.size(), 20u * 500u);
  geometry::TriangleMesh same = Box({0, 0, 0}, {1, 1, 1});
  for (int i = 0; i < 6; ++i) same = Joined(same, same);
  ShapeOptions options;
  options.levels_max = 6;
  ExpectCovered(same, options, 100, random);
}

TEST(Octree, SameInputGivesTheSameBits) {
  Random random(66);
  const geometry::TriangleMesh mesh = Star(3, random);
  const SphereTree a = BuildOctree(mesh, {}), b = BuildOctree(mesh, {});
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  EXPECT_EQ(a.elements, b.elements);
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    ASSERT_EQ(a.nodes[i].centre, b.nodes[i].centre);
    ASSERT_EQ(a.nodes[i].radius, b.nodes[i].radius);
  }
}

}  // namespace
}  // namespace collision::sphere_tree
