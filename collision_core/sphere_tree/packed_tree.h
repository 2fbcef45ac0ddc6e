// The sphere tree once more, laid out for wide vectors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/packed_layout.h"
#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::sphere_tree {

/// What a ball holds: the pack of its children, or the first block of its leaf; and how many.
struct BallLink {
  static constexpr std::uint32_t kLeaf = 1u << 31;
  static constexpr std::uint32_t kIndexBits = 28;

  static constexpr bool IsLeaf(std::uint32_t link) { return (link & kLeaf) != 0; }
  static constexpr std::uint32_t Index(std::uint32_t link) {
    return link & ((1u << kIndexBits) - 1);
  }
  /// Children of a node.
  static constexpr std::uint32_t Count(std::uint32_t link) {
    return ((link >> kIndexBits) & 7) + 1;
  }
};

/// A ball of the packed tree: kPackBalls times its pack, plus its place there.
using BallRef = std::uint32_t;

/// The sphere tree in the order in which traversals read it: packs of up to eight balls and blocks
/// of four triangles, in single precision, relative to the middle of the tree. Balls are rounded
/// outward, triangles to nearest. 224 bytes for each pack (28 a ball where packs are full), 256 for
/// each four triangles of a leaf, or for a convex solid: then `element[0]` is that solid, and the
/// corners are not used.
///
/// Packs stand in breadth-first order; the first one holds the root alone. The pack of a ball is a
/// cut through its subtree with up to eight nodes: starting from the children, the node with the
/// largest overshoot is replaced by its children as long as they fit. So packs are fuller than the
/// tree's nodes have children.
class PackedTree {
 public:
  PackedTree() = default;
  /// Requires a tree with a root. Unchecked: it is a tree of this mesh as sphere_tree.h states it.
  PackedTree(const geometry::TriangleMesh& mesh, const SphereTree& tree);

  const BallPack* packs() const { return packs_.data(); }
  const TriangleBlock* blocks() const { return blocks_.data(); }
  std::uint32_t LinkOf(BallRef ball) const {
    return packs_[ball / kPackBalls].link[ball % kPackBalls];
  }

  /// The node of the sphere tree that a ball stands for.
  NodeIndex NodeOf(BallRef ball) const { return nodes_[ball]; }

  /// In the body frame [m].
  const Eigen::Vector3d& origin() const { return origin_; }
  /// Every ball, every ball of radius |signed distance| about a centre, and every corner lies
  /// within this distance of origin() [m].
  double extent() const { return extent_; }

  /// The vertices of the surface that are the farthest in fourteen directions: along ± each axis,
  /// then along the eight diagonals of a cube. Solids are not counted.
  const std::array<Eigen::Vector3d, 14>& extremes() const { return extremes_; }

  std::size_t bytes() const;

 private:
  struct PackSlot;
  struct PackSlots;

  static PackSlots SlotsOf(const SphereTree& tree, const PackSlot& parent);
  std::uint32_t AddLeaf(const geometry::TriangleMesh& mesh, const SphereTree& tree,
                        const SphereNode& leaf);
  void SetBall(const SphereNode& node, BallRef ball);
  void SetElement(const geometry::TriangleMesh& mesh, ElementIndex element, std::uint32_t lane,
                  TriangleBlock* block);
  void FindExtremes(const geometry::TriangleMesh& mesh);

  std::vector<BallPack> packs_;
  std::vector<NodeIndex> nodes_;  ///< The nodes of the sphere tree, lane by lane.
  std::vector<TriangleBlock> blocks_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double extent_ = 0;
  std::array<Eigen::Vector3d, 14> extremes_ = {};
};

/// The pack of a plain ball about the reference point [m]: a leaf without triangles.
BallPack PackOfBall(double radius);

}  // namespace collision::sphere_tree
