// Nested spheres that cover a surface, from both sides.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision_core/base/ids.h"

namespace collision::sphere_tree {

/// Limits that hold on every machine, against hostile meshes: thousands of large triangles that
/// cross each other, needles, or coincident copies. No cut separates such triangles, and a ball is
/// about equally far from all of them. Leaves hold at most kGrowthMax pieces per triangle of the
/// mesh, plus kGrowthMore (ordinary models need 6 to 14). The fitted builder stops searching and
/// measuring after kWorkPerTriangle boxes and triangles per triangle, plus kWorkMore
/// (fitted_builder.cc); for the other builders, measuring distances stops after kWorkPerBall per
/// ball (shape/shape.cc). Trees are built level by level, so only the finest levels suffer: there a
/// node stays undivided, or is halved by position with a simple ball, or keeps its radius as its
/// signed distance. All of these are valid.
inline constexpr std::size_t kGrowthMax = 64;
inline constexpr std::size_t kGrowthMore = 1024;
/// The most pieces of triangles in the leaves of one tree.
constexpr std::size_t PiecesMax(std::size_t triangles) {
  return kGrowthMax * triangles + kGrowthMore;
}

/// One ball of the tree. It contains its part of the surface (triangles, clipped); the parts of a
/// node's children unite to the node's own part. Radius and signed distance bound the surface from
/// both sides: the ball of radius −signed_distance about the centre belongs to the solid, and the
/// ball overshoots the surface by radius + signed_distance at most.
struct SphereNode {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< In the body frame [m].
  double radius = 0;                                 ///< [m], rounded up.
  /// Signed distance of the centre to the whole surface [m], rounded up: negative inside a closed
  /// solid, where the ball of that radius about the centre belongs to the solid. Where the sign is
  /// uncertain, and for open surfaces, the distance.
  double signed_distance = 0;
  std::uint32_t first_child = 0;    ///< Children stand one after the other.
  std::uint32_t children = 0;       ///< How many; 0: a leaf.
  std::uint32_t first_element = 0;  ///< For a leaf: where it begins in SphereTree::elements.
  std::uint32_t elements = 0;       ///< For a leaf: how many it has.
  std::uint32_t level = 0;          ///< The root's is 0.

  bool is_leaf() const { return children == 0; }
  /// Child `i`, counted from 0. Unchecked: i < children.
  NodeIndex child(std::uint32_t i) const { return NodeIndex(first_child + i); }
};

/// A tree of balls that covers a surface. Nodes stand in breadth-first order: the root first, each
/// level in one run, children after parents.
struct SphereTree {
  /// The root of every tree.
  static constexpr NodeIndex kRoot{std::uint32_t{0}};

  std::vector<SphereNode> nodes;
  /// The elements of each leaf, whole: the leaf's part lies within them. A builder's tree has
  /// triangles only; a compound's also has convex solids, each a leaf of its own.
  std::vector<ElementIndex> elements;
  std::uint32_t levels = 0;  ///< The deepest level + 1.

  const SphereNode& root() const { return nodes.front(); }
  std::span<const SphereNode> ChildrenOf(const SphereNode& node) const {
    return {nodes.data() + node.first_child, node.children};
  }
  const SphereNode& node(NodeIndex index) const { return nodes[index.value()]; }
  std::span<const ElementIndex> ElementsOf(const SphereNode& node) const {
    return {elements.data() + node.first_element, node.elements};
  }

  /// Level `level` as a cut through the tree: its nodes, and the leaves above it. Together their
  /// parts are the whole surface.
  std::vector<NodeIndex> Cut(std::uint32_t level) const;

  /// Memory in use [bytes].
  std::size_t bytes() const;
};

}  // namespace collision::sphere_tree
