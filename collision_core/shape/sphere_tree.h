// Nested spheres that cover a surface, from both sides.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace collision {

/// Leaves hold no more pieces of triangles than this many times the mesh's triangles, and so many
/// more: what would be cut into more stays whole. Thousands of large triangles that cross each other
/// are in everybody's way, and no cut takes them apart.
inline constexpr std::size_t kGrowthMax = 64;
inline constexpr std::size_t kGrowthMore = 1024;
constexpr std::size_t PiecesMax(std::size_t triangles) {
  return kGrowthMax * triangles + kGrowthMore;
}

/// One ball. It contains its part of the surface (triangles, clipped); the parts of a node's
/// children unite to the node's own part.
struct SphereNode {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< In the body frame [m].
  double radius = 0;                                 ///< [m], rounded up.
  /// Signed distance of the centre to the whole surface [m], rounded up: negative inside a closed
  /// solid, where the ball of that radius about the centre belongs to the solid. Where the sign is
  /// uncertain, and for open surfaces, the distance.
  double signed_distance = 0;
  std::uint32_t first_child = 0;     ///< Children stand one after the other.
  std::uint32_t children = 0;        ///< 0: a leaf.
  std::uint32_t first_triangle = 0;  ///< Of a leaf: into SphereTree::triangle_indices.
  std::uint32_t triangles = 0;
  std::uint32_t level = 0;  ///< The root's is 0.
};

/// Nodes in breadth-first order: the root first, each level in one run, children after parents.
struct SphereTree {
  std::vector<SphereNode> nodes;
  /// The triangles of each leaf, whole: the leaf's part lies within them.
  std::vector<std::uint32_t> triangle_indices;
  std::uint32_t levels = 0;  ///< The deepest level + 1.

  const SphereNode& root() const { return nodes.front(); }
  std::span<const SphereNode> ChildrenOf(const SphereNode& node) const {
    return {nodes.data() + node.first_child, node.children};
  }
  std::span<const std::uint32_t> TrianglesOf(const SphereNode& node) const {
    return {triangle_indices.data() + node.first_triangle, node.triangles};
  }

  /// Level `level` as a cut through the tree: its nodes, and the leaves above it. Together their
  /// parts are the whole surface.
  std::vector<std::uint32_t> Cut(std::uint32_t level) const;

  /// What it keeps in memory.
  std::size_t bytes() const;
};

}  // namespace collision
