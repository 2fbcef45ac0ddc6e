#include "collision_core/sphere_tree/tree_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "collision_core/shape/shape.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace collision::sphere_tree {
namespace {

SphereTree TreeOf(const geometry::TriangleMesh& mesh) {
  return shape::Shape::Build(mesh, {.triangles_per_leaf = 1})->tree();
}

// Goal:   what a builder makes passes, and a shape from it is the shape that was built.
TEST(TreeCheck, WhatWasBuiltPasses) {
  for (const geometry::TriangleMesh& mesh : {Cube(1), Tetrahedron(2), LShape(), Sheet(3, 7)}) {
    const auto built = shape::Shape::Build(mesh);
    ASSERT_EQ(RefusalOf(built->tree(), mesh), std::nullopt);
    const auto again = shape::Shape::FromTree(mesh, built->tree());
    EXPECT_EQ(again->closed(), built->closed());
    EXPECT_EQ(again->facts().radius, built->facts().radius);
    EXPECT_EQ(again->component_points(), built->component_points());
    const Eigen::Vector3d point(0.3, -0.2, 0.1);
    EXPECT_EQ(again->DistanceTo(point).lower, built->DistanceTo(point).lower);
    EXPECT_EQ(again->DistanceTo(point).upper, built->DistanceTo(point).upper);
  }
}

// Goal:   each thing that could lead a traversal astray is refused.
// Method: a good tree, spoilt in one place.
TEST(TreeCheck, RefusesWhatIsNoTreeOfTheMesh) {
  const geometry::TriangleMesh mesh = LShape();
  const SphereTree good = TreeOf(mesh);
  ASSERT_EQ(RefusalOf(good, mesh), std::nullopt);
  ASSERT_GE(good.levels, 3u);
  std::size_t leaf = 0;
  while (good.nodes[leaf].children > 0) ++leaf;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::function<void(SphereTree&)>> spoils = {
      [](SphereTree& t) { t.nodes.clear(); },
      [](SphereTree& t) { t.nodes.pop_back(); },
      [](SphereTree& t) { t.nodes.push_back(t.nodes.back()); },
      [](SphereTree& t) { t.nodes[0].level = 1; },
      [](SphereTree& t) { t.nodes[1].level = 2; },
      [](SphereTree& t) { t.nodes[0].first_child = 0; },
      [](SphereTree& t) { t.nodes[0].first_child = 2; },
      [](SphereTree& t) { t.nodes[0].children += 1; },
      [](SphereTree& t) { t.nodes[0].children = 0xffffffff; },
      [](SphereTree& t) { t.nodes[0].children = 0; },
      [](SphereTree& t) { t.levels += 1; },
      [](SphereTree& t) { t.levels = 0; },
      [&](SphereTree& t) { t.nodes[leaf].elements = 0; },
      [&](SphereTree& t) { t.nodes[leaf].elements = 0xffffffff; },
      [&](SphereTree& t) { t.nodes[leaf].first_element = 0xfffffff0; },
      [&](SphereTree& t) { t.nodes[leaf].first_child = 0, t.nodes[leaf].children = 1; },
      [](SphereTree& t) { t.elements[0] = ElementIndex(20u); },
      [](SphereTree& t) { std::fill(t.elements.begin(), t.elements.end(), ElementIndex()); },
      [](SphereTree& t) { t.elements.pop_back(); },
      [](SphereTree& t) { t.elements.emplace_back(); },
      [](SphereTree& t) { t.nodes[0].elements = 1; },
      [](SphereTree& t) { t.nodes[0].elements = static_cast<std::uint32_t>(t.elements.size()); },
      [&](SphereTree& t) { t.nodes[2].centre.x() = nan; },
      [&](SphereTree& t) { t.nodes[2].centre.y() = -infinity; },
      [&](SphereTree& t) { t.nodes[2].centre.z() = 1e30; },
      [&](SphereTree& t) { t.nodes[2].radius = nan; },
      [&](SphereTree& t) { t.nodes[2].radius = infinity; },
      [](SphereTree& t) { t.nodes[2].radius = -1e-9; },
      [&](SphereTree& t) { t.nodes[2].signed_distance = nan; },
      [&](SphereTree& t) { t.nodes[2].signed_distance = -infinity; },
  };
  for (std::size_t i = 0; i < spoils.size(); ++i) {
    SphereTree tree = good;
    spoils[i](tree);
    EXPECT_NE(RefusalOf(tree, mesh), std::nullopt) << "spoilt in way " << i;
  }
  geometry::TriangleMesh more = mesh;
  more.triangles.push_back(more.triangles.front());
  EXPECT_NE(RefusalOf(good, more), std::nullopt) << "a triangle in no leaf";
}

// Goal:   the tree of a compound passes with its solids, and each of them is alone in one leaf.
// Method: three balls with and without a surface; a good tree, spoilt in one place.
TEST(TreeCheck, ACompoundsTreeHasItsSolids) {
  std::vector<shape::ConvexSolid> solids;
  for (const double x : {-4.0, 0.0, 9.0}) {
    shape::ConvexDescription ball;
    ball.p_BS.x() = x;
    ball.rounding = 1;
    solids.push_back(shape::ConvexSolid::Build(ball));
  }
  const auto bare = shape::Shape::Compound(nullptr, solids);
  EXPECT_EQ(RefusalOf(bare->tree(), TreeElements{.solids = 3}), std::nullopt);
  EXPECT_NE(RefusalOf(bare->tree(), TreeElements{.solids = 4}), std::nullopt);
  const geometry::TriangleMesh mesh = LShape();
  const TreeElements wanted{.triangles = mesh.triangles.size(), .solids = 3};
  const SphereTree good = shape::Shape::Compound(shape::Shape::Build(mesh), solids)->tree();
  ASSERT_EQ(RefusalOf(good, wanted), std::nullopt);
  EXPECT_NE(RefusalOf(good, mesh), std::nullopt) << "its solids are no triangles";
  EXPECT_NE(RefusalOf(good, TreeElements{wanted.triangles, 2}), std::nullopt);
  EXPECT_NE(RefusalOf(good, TreeElements{wanted.triangles, 4}), std::nullopt);
  EXPECT_NE(RefusalOf(good, TreeElements{wanted.triangles, good.elements.size() + 1}),
            std::nullopt);
  const std::size_t pieces = good.elements.size() - 3;
  const auto leaf_at = [&](std::size_t element) {
    std::size_t leaf = 0;
    while (good.nodes[leaf].children > 0 || good.nodes[leaf].first_element != element) ++leaf;
    return leaf;
  };
  const std::size_t first = leaf_at(0), solid = leaf_at(pieces), last = leaf_at(pieces + 2);
  const std::vector<std::function<void(SphereTree&)>> spoils = {
      [&](SphereTree& t) { t.elements[pieces] = t.elements[pieces + 1]; },
      [&](SphereTree& t) { t.elements[pieces] = t.elements[0]; },
      [&](SphereTree& t) { t.elements[0] = t.elements[pieces]; },
      [&](SphereTree& t) { t.nodes[solid].elements = 2; },
      [&](SphereTree& t) { t.nodes[last].elements = 2; },
      [&](SphereTree& t) { t.nodes[last].first_element -= 1; },
      [&](SphereTree& t) { t.nodes[first].first_element = static_cast<std::uint32_t>(pieces); },
  };
  for (std::size_t i = 0; i < spoils.size(); ++i) {
    SphereTree tree = good;
    spoils[i](tree);
    EXPECT_NE(RefusalOf(tree, wanted), std::nullopt) << "spoilt in way " << i;
  }
}

TEST(TreeCheck, TwoSolidsShareNoLeaf) {
  SphereTree tree;
  tree.levels = 1;
  tree.nodes.push_back({.radius = 2, .elements = 2});
  tree.elements = {ElementIndex(0u), ElementIndex(1u)};
  EXPECT_EQ(RefusalOf(tree, TreeElements{.triangles = 2}), std::nullopt);
  EXPECT_NE(RefusalOf(tree, TreeElements{.solids = 2}), std::nullopt);
}

// Goal:   packs have room for all siblings.
// Method: leaves of one triangle each below a root, up to eight and nine.
TEST(TreeCheck, SiblingsAreFew) {
  for (const std::uint32_t children : {8u, 9u}) {
    geometry::TriangleMesh mesh = Sheet(1, 3);
    mesh.triangles.resize(children);
    SphereTree tree;
    tree.levels = 2;
    tree.nodes.push_back({.radius = 2, .first_child = 1, .children = children});
    for (std::uint32_t i = 0; i < children; ++i) {
      tree.nodes.push_back({.radius = 2, .first_element = i, .elements = 1, .level = 1});
      tree.elements.emplace_back(i);
    }
    EXPECT_EQ(RefusalOf(tree, mesh).has_value(), children > kNodeChildrenMax);
  }
}

/// Under a root: leaves that say they begin at `first` and hold `count` triangles each.
SphereTree TwoLeaves(const std::vector<std::uint32_t>& triangles, std::uint32_t first,
                     std::uint32_t count) {
  SphereTree tree;
  tree.levels = 2;
  for (const std::uint32_t triangle : triangles) tree.elements.emplace_back(triangle);
  tree.nodes.push_back({.radius = 2, .first_child = 1, .children = 2});
  tree.nodes.push_back({.radius = 2, .elements = count, .level = 1});
  tree.nodes.push_back({.radius = 2, .first_element = first, .elements = count, .level = 1});
  return tree;
}

// Goal:   a small tree makes no traversal take more steps than it has numbers.
// Method: leaves upon each other, beside each other; the same triangle twice in a leaf, once in
// both.
TEST(TreeCheck, LeavesShareNoLists) {
  geometry::TriangleMesh mesh = Sheet(1, 1);
  EXPECT_EQ(RefusalOf(TwoLeaves({0, 1}, 1, 1), mesh), std::nullopt);
  EXPECT_EQ(RefusalOf(TwoLeaves({0, 1, 0, 1}, 2, 2), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(TwoLeaves({0, 1}, 0, 2), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(TwoLeaves({0, 1, 0}, 1, 2), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(TwoLeaves({0, 1, 1, 0}, 2, 2), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(TwoLeaves({0, 0, 1, 1}, 2, 2), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(TwoLeaves({0, 1, 0, 1, 0}, 2, 2), mesh), std::nullopt);
}

/// Each node has two leaves but the last of its children, which goes on, `depth` times.
SphereTree Comb(std::uint32_t depth, std::uint32_t children, std::uint32_t triangles) {
  SphereTree tree;
  tree.levels = depth + 1;
  tree.nodes.push_back({.radius = 2});
  for (std::uint32_t level = 1; level <= depth; ++level) {
    tree.nodes.back().first_child = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.back().children = children;
    for (std::uint32_t i = 0; i < children; ++i) {
      tree.nodes.push_back({.radius = 2, .level = level});
    }
  }
  for (SphereNode& node : tree.nodes) {
    if (node.children > 0) continue;
    node.first_element = static_cast<std::uint32_t>(tree.elements.size());
    node.elements = triangles;
    for (std::uint32_t i = 0; i < triangles; ++i) tree.elements.emplace_back(i);
  }
  return tree;
}

// Goal:   no tree is deeper, or holds more, than a builder's would.
// Method: combs on either side of each bound.
TEST(TreeCheck, TreesAreBoundedByTheirMesh) {
  geometry::TriangleMesh mesh = Sheet(1, 4);
  EXPECT_EQ(RefusalOf(Comb(kTreeDepthMax - 1, 2, 32), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(Comb(kTreeDepthMax, 2, 32), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(Comb(3, 1, 32), mesh), std::nullopt);
  // 32 triangles in each of 7 leaves a level, and one.
  const auto levels = static_cast<std::uint32_t>(PiecesMax(32) / (7 * 32));
  ASSERT_LT(levels, kTreeDepthMax);
  EXPECT_EQ(RefusalOf(Comb(levels - 1, 8, 32), mesh), std::nullopt);
  EXPECT_NE(RefusalOf(Comb(levels + 1, 8, 32), mesh), std::nullopt);
}

// Goal:   whatever passes can be walked: every query about it ends, within its arrays.
// Method: 5,000 trees with words overwritten at random; those that pass are asked (the sanitizers
//         watch), and some do pass.
TEST(TreeCheck, WhateverPassesCanBeUsed) {
  Random random(12);
  const geometry::TriangleMesh mesh = LShape();
  const SphereTree good = TreeOf(mesh);
  int passed = 0;
  for (int i = 0; i < 5'000; ++i) {
    SphereTree tree = good;
    for (std::uint64_t n = 1 + random.Below(3); n > 0; --n) {
      SphereNode& node = tree.nodes[random.Below(tree.nodes.size())];
      std::uint32_t* const words[] = {&node.first_child, &node.children, &node.first_element,
                                      &node.elements, &node.level};
      double* const numbers[] = {&node.centre.x(), &node.radius, &node.signed_distance};
      if (random.Chance(0.5)) {
        *words[random.Below(5)] = static_cast<std::uint32_t>(random.Below(24));
      } else if (random.Chance(0.5)) {
        *numbers[random.Below(3)] = std::ldexp(1.0, static_cast<int>(random.Below(2000)) - 1000);
      } else {
        tree.elements[random.Below(tree.elements.size())] =
            ElementIndex(static_cast<std::uint32_t>(random.Below(24)));
      }
    }
    if (RefusalOf(tree, mesh)) continue;
    ++passed;
    const auto shape = shape::Shape::FromTree(mesh, tree);
    shape->DistanceTo({2, 1, 0});
    shape->WindingNumberAt({0.25, -0.5, 0.25});
    for (std::uint32_t level = 0; level < tree.levels; ++level) shape->tree().Cut(level);
  }
  EXPECT_GT(passed, 200);
}

}  // namespace
}  // namespace collision::sphere_tree
