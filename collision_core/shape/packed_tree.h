// The sphere tree once more, laid out for wide vectors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "collision_core/shape/ball_pack.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

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

/// Which ball: its pack, and its place there.
using BallRef = std::uint32_t;

/// 224 bytes for each pack (28 a ball where packs are full), 256 for each four
/// triangles of a leaf, or for a convex solid: then `triangle[0]` is its element, and no corner says
/// anything. Packs stand in breadth-first order; the first one holds the root alone. A ball's pack is
/// a cut through what is below it, as wide as there is room: in place of the node that overshoots the
/// surface most stand its children, and so on.
class PackedTree {
 public:
  PackedTree() = default;
  /// Requires a tree of this mesh as sphere_tree.h states it.
  PackedTree(const TriangleMesh& mesh, const SphereTree& tree);

  const BallPack* packs() const { return packs_.data(); }
  const TriangleBlock* blocks() const { return blocks_.data(); }
  std::uint32_t LinkOf(BallRef ball) const {
    return packs_[ball / kPackBalls].link[ball % kPackBalls];
  }

  /// Of the sphere tree.
  std::uint32_t NodeOf(BallRef ball) const { return nodes_[ball]; }

  /// In the body frame [m].
  const Eigen::Vector3d& origin() const { return origin_; }
  /// No centre, with its radius or its signed distance, and no corner is farther from the origin.
  double extent() const { return extent_; }

  /// Vertices that are the farthest in fourteen directions: along the axes, then across the corners.
  /// Of the surface; solids count for nothing here.
  const std::array<Eigen::Vector3d, 14>& extremes() const { return extremes_; }

  std::size_t bytes() const;

 private:
  struct Lane;
  struct Lanes;

  static Lanes LanesOf(const SphereTree& tree, const Lane& parent);
  std::uint32_t AddLeaf(const TriangleMesh& mesh, const SphereTree& tree, const SphereNode& leaf);
  void SetBall(const SphereNode& node, BallRef ball);
  void SetTriangle(const TriangleMesh& mesh, std::uint32_t triangle, std::uint32_t lane,
                   TriangleBlock* block);
  void FindExtremes(const TriangleMesh& mesh);

  std::vector<BallPack> packs_;
  std::vector<std::uint32_t> nodes_;  ///< Of the sphere tree, lane by lane.
  std::vector<TriangleBlock> blocks_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double extent_ = 0;
  std::array<Eigen::Vector3d, 14> extremes_ = {};
};

/// The pack of a ball alone, about the reference point: a leaf without triangles.
BallPack PackOfBall(double radius);

}  // namespace collision
