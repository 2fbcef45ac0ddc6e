// Goal:   the descent of two trees comes to every pair of leaves once, by opening the larger node.
// Method: all pairs of nodes of two trees of unequal shapes, followed down to the leaves.
#include "collision_core/narrow_phase/pose/node_pair.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "tests/collision_core/narrow_phase/posed_body.h"
#include "tests/support/meshes.h"

namespace collision::narrow_phase {
namespace {

BodySegment BodyOf(const geometry::TriangleMesh& mesh) {
  BodySegment body;
  body.shape = shape::Shape::Build(mesh);
  body.ball.radius = body.shape->facts().radius;
  return body;
}

std::size_t LeavesOf(const BodySegment& body) {
  std::size_t leaves = 0;
  for (const sphere_tree::SphereNode& node : body.shape->tree().nodes) leaves += node.children == 0;
  return leaves;
}

TEST(OpenLarger, ComesToEveryPairOfLeavesOnce) {
  const BodySegment box = BodyOf(Cube(1)), rod = BodyOf(Cube(0.25));
  const BodyTree a(box), b(rod);
  std::set<NodePair> leaves;
  std::vector<NodePair> open = {{}};
  while (!open.empty()) {
    const NodePair pair = open.back();
    open.pop_back();
    const auto keep = [&](NodePair children) { open.push_back(children); };
    if (OpenLarger(a, b, pair, keep)) continue;
    EXPECT_EQ(a.node(pair.a).children, 0u);
    EXPECT_EQ(b.node(pair.b).children, 0u);
    EXPECT_TRUE(leaves.insert(pair).second) << pair.a.value() << ", " << pair.b.value();
  }
  EXPECT_EQ(leaves.size(), LeavesOf(box) * LeavesOf(rod));
}

TEST(OpenLarger, OpensTheLargerNodeInTheOrderOfItsChildren) {
  const BodySegment large = BodyOf(Cube(1)), small = BodyOf(Cube(0.25));
  const BodyTree a(large), b(small);
  ASSERT_FALSE(a.root().is_leaf());
  std::vector<NodeIndex> opened;
  EXPECT_TRUE(OpenLarger(a, b, {}, [&](NodePair pair) {
    EXPECT_EQ(pair.b, sphere_tree::SphereTree::kRoot);
    opened.push_back(pair.a);
  }));
  EXPECT_TRUE(OpenLarger(b, a, {}, [&](NodePair pair) {
    EXPECT_EQ(pair.a, sphere_tree::SphereTree::kRoot);
    opened.push_back(pair.b);
  }));
  const std::uint32_t children = a.root().children;
  ASSERT_EQ(opened.size(), 2 * children);
  for (std::uint32_t i = 0; i < 2 * children; ++i)
    EXPECT_EQ(opened[i], a.root().child(i % children));
}

TEST(OpenLarger, ABallIsALeaf) {
  BodySegment ball;
  ball.ball.radius = 8;
  const BodySegment box = BodyOf(Cube(0.25));
  const BodyTree a(ball), b(box);
  std::size_t visits = 0;
  EXPECT_EQ(OpenLarger(a, b, {},
                       [&](NodePair pair) {
                         EXPECT_EQ(pair.a, sphere_tree::SphereTree::kRoot);
                         ++visits;
                       }),
            !b.root().is_leaf());
  EXPECT_EQ(visits, b.root().children);
  EXPECT_FALSE(OpenLarger(a, a, {}, [&](NodePair) { FAIL(); }));
}

}  // namespace
}  // namespace collision::narrow_phase
