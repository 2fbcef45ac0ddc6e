// Goal:   the packed tree says the same as the sphere tree, and nothing that is not certain.
// Method: exact rational arithmetic, ball by ball and corner by corner, for surfaces of all sizes
//         and far from their reference points; trees with many children by hand.
#include "collision_core/sphere_tree/packed_tree.h"

#include <gtest/gtest.h>

#include "collision_core/sphere_tree/octree/octree_builder.h"
#include "tests/support/meshes.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision::sphere_tree {
namespace {

ExactVector PlaceIn(const PackedTree& packed, float x, float y, float z) {
  return ExactVector(packed.origin()) + ExactVector(Exact(x), Exact(y), Exact(z));
}

/// Whether |v| <= bound.
bool IsWithin(const ExactVector& v, const Exact& bound) {
  return bound >= 0 && Square(v) <= bound * bound;
}

struct Walk {
  const geometry::TriangleMesh& mesh;
  const SphereTree& tree;
  const PackedTree& packed;
  std::vector<int> seen;  ///< How often each node was met.
  double loosest = 0;     ///< Of radii, beside the extent.
  std::vector<std::uint32_t> parents;

  void Run() {
    seen.assign(tree.nodes.size(), 0);
    parents.assign(tree.nodes.size(), 0);
    for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
      const SphereNode& parent = tree.nodes[node];
      for (std::uint32_t i = 0; i < parent.children; ++i) parents[parent.first_child + i] = node;
    }
    Visit(0);
    for (std::size_t node = 0; node < seen.size(); ++node) {
      // Lanes that share out many children stand for their parent, all of them; other nodes may
      // have made way for their children.
      const std::uint32_t children = tree.nodes[node].children;
      EXPECT_TRUE(seen[node] == 1 || (seen[node] == 0 && children > 0) || children > kPackBalls);
    }
  }

  bool IsBelow(std::uint32_t node, std::uint32_t above) const {
    while (node > above) node = parents[node];
    return node == above;
  }

  void Visit(BallRef ball) {
    const std::uint32_t number = packed.NodeOf(ball).value();
    const SphereNode& node = tree.nodes[number];
    CheckBall(packed.packs()[ball / kPackBalls], ball % kPackBalls, node);
    const std::uint32_t link = packed.LinkOf(ball);
    ++seen[number];
    if (BallLink::IsLeaf(link)) {
      ASSERT_EQ(node.children, 0u);
      CheckLeaf(packed.blocks() + BallLink::Index(link), node);
      return;
    }
    const BallRef first = BallLink::Index(link) * kPackBalls;
    const std::uint32_t count = BallLink::Count(link);
    for (std::uint32_t i = 0; i < kPackBalls; ++i) {
      if (i >= count) {
        EXPECT_EQ(packed.packs()[BallLink::Index(link)].radius[i], -kFarDistance);
        EXPECT_EQ(packed.packs()[BallLink::Index(link)].x[i], kFarCoordinate);
        continue;
      }
      const std::uint32_t lane = packed.NodeOf(first + i).value();
      EXPECT_TRUE(IsBelow(lane, number));
      const std::uint32_t children = tree.nodes[lane].children;
      if (lane != number && children > 0) {
        EXPECT_GT(count - 1 + children, kPackBalls) << "room is left";
      }
      Visit(first + i);
    }
  }

  void CheckBall(const BallPack& pack, std::uint32_t i, const SphereNode& node) {
    const ExactVector centre = PlaceIn(packed, pack.x[i], pack.y[i], pack.z[i]);
    const ExactVector moved = centre - ExactVector(node.centre);
    const Exact radius = Exact(pack.radius[i]), distance = Exact(pack.signed_distance[i]);
    EXPECT_TRUE(IsWithin(moved, radius - Exact(node.radius)));
    EXPECT_TRUE(IsWithin(moved, distance - Exact(node.signed_distance)));
    const double more = pack.radius[i] - node.radius;
    loosest = std::max(loosest, more / packed.extent());
    const Exact extent = packed.extent();
    const ExactVector seen_from_origin = centre - ExactVector(packed.origin());
    EXPECT_TRUE(IsWithin(seen_from_origin, extent - radius));
    EXPECT_TRUE(IsWithin(seen_from_origin, extent - abs(distance)));
  }

  void CheckLeaf(const TriangleBlock* block, const SphereNode& leaf) {
    const auto triangles = tree.ElementsOf(leaf);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto i = static_cast<std::uint32_t>(k % kBlockTriangles);
      const TriangleBlock& here = block[k / kBlockTriangles];
      EXPECT_EQ(here.left, triangles.size() - (k - i));
      ASSERT_EQ(here.element[i], triangles[k]);
      CheckTriangle(here, i);
    }
  }

  void CheckTriangle(const TriangleBlock& block, std::uint32_t i) {
    const Exact tolerance = Exact(packed.extent()) * Exact(0x1p-23);
    const ExactVector normal(Exact(block.x[12 + i]), Exact(block.y[12 + i]),
                             Exact(block.z[12 + i]));
    EXPECT_LE(Square(normal), Exact(1) + Exact(0x1p-20));
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& vertex = mesh.vertices[mesh.triangles[block.element[i].value()][k]];
      const ExactVector at(Exact(block.x[4 * k + i]), Exact(block.y[4 * k + i]),
                           Exact(block.z[4 * k + i]));
      const ExactVector true_at = ExactVector(vertex) - ExactVector(packed.origin());
      EXPECT_TRUE(IsWithin(at - true_at, tolerance));
      EXPECT_TRUE(IsWithin(ExactVector(vertex), Exact(block.reach)));
      EXPECT_LE(Dot(normal, at), Exact(block.above[i]) + tolerance);
      EXPECT_GE(Dot(normal, at), Exact(block.below[i]) - tolerance);
    }
  }
};

TEST(PackedTree, HoldsTheSphereTreeExactly) {
  Random random(1);
  const geometry::TriangleMesh meshes[] = {Sphere(1), Frame(), Sheet(1, 3), Star(1, random),
                                           Rod(3, 0.01)};
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double away : {0.0, 1.0, 1e6}) {
      for (const geometry::TriangleMesh& unit : meshes) {
        const geometry::TriangleMesh mesh =
            Moved(Scaled(unit, scale), Eigen::Vector3d(away, -away, 0));
        if (away > 1e6 * scale) continue;  // smaller than its coordinates can tell
        SphereTree tree = BuildOctree(mesh, {});
        for (SphereNode& node : tree.nodes) node.signed_distance = random.Uniform(-1, 1) * scale;
        const PackedTree packed(mesh, tree);
        Walk walk{mesh, tree, packed, {}, 0, {}};
        walk.Run();
        EXPECT_LT(walk.loosest, 0x1p-22) << "no more than rounding";
        EXPECT_GT(packed.bytes(), 0u);
      }
    }
  }
}

TEST(PackedTree, TakesAnyNumberOfChildren) {
  for (const std::uint32_t children : {2u, 7u, 8u, 9u, 16u, 63u, 64u, 65u, 200u, 600u}) {
    const geometry::TriangleMesh mesh = Subdivided(Sphere(0), 4);
    SphereTree tree;
    tree.levels = 2;
    SphereNode node;
    node.radius = 2, node.signed_distance = 1, node.first_child = 1, node.children = children;
    tree.nodes.push_back(node);
    node.children = node.first_child = 0, node.level = 1, node.elements = 3;
    for (std::uint32_t i = 0; i < children; ++i) {
      node.first_element = 3 * i;
      for (std::uint32_t k = 0; k < 3; ++k) tree.elements.emplace_back(3 * i + k);
      tree.nodes.push_back(node);
    }
    const PackedTree packed(mesh, tree);
    Walk walk{mesh, tree, packed, {}, 0, {}};
    walk.Run();
  }
}

TEST(PackedTree, OneNodeAndLargeLeaves) {
  const geometry::TriangleMesh mesh = Sphere(2);
  ShapeOptions options;
  for (const std::uint32_t size : {1u, 3u, 4u, 5u, 1000u}) {
    options.triangles_per_leaf = size;
    const SphereTree tree = BuildOctree(mesh, options);
    const PackedTree packed(mesh, tree);
    Walk walk{mesh, tree, packed, {}, 0, {}};
    walk.Run();
  }
}

TEST(PackedTree, ExtremesAreTheFarthestVertices) {
  Random random(2);
  const geometry::TriangleMesh mesh = Moved(Star(2, random), {5, 0, 0});
  const PackedTree packed(mesh, BuildOctree(mesh, {}));
  for (int axis = 0; axis < 3; ++axis) {
    double high = -1e300, low = 1e300;
    for (const auto& p : mesh.vertices) {
      high = std::max(high, p[axis]), low = std::min(low, p[axis]);
    }
    EXPECT_EQ(packed.extremes()[2 * axis][axis], high);
    EXPECT_EQ(packed.extremes()[2 * axis + 1][axis], low);
  }
}

}  // namespace
}  // namespace collision::sphere_tree
