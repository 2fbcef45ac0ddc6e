// Proof that the balls of a sphere tree cover a surface, without the code that built it.
#pragma once

#include <array>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "tests/support/truth/exact_dyadic.h"

namespace collision {

/// Shows of each triangle that it is covered: it is halved, exactly, until all corners of each
/// sub-triangle lie in every ball on the way from the root to *one* leaf that lists the triangle.
/// An intersection of balls is convex, so the sub-triangle lies in it. It follows that every cut
/// covers the surface, that parts of children unite to their parent's, and that leaves list what
/// they hold.
///
/// Halved is the longest edge, as it is stored, at its exact middle. No sampling, no allowance:
/// where doubles do not decide by far, exact numbers do. Link with gmp.
class TreeCoverage {
 public:
  TreeCoverage(const geometry::TriangleMesh& mesh, const sphere_tree::SphereTree& tree)
      : mesh_(mesh), tree_(tree) {
    parent_.assign(tree.nodes.size(), 0);
    leaves_of_.resize(mesh.triangles.size());
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
      const sphere_tree::SphereNode& node = tree.nodes[i];
      for (std::uint32_t k = 0; k < node.children; ++k) parent_[node.first_child + k] = i;
      for (const ElementIndex triangle : tree.ElementsOf(node)) {
        leaves_of_[triangle.value()].push_back(i);
      }
    }
  }

  /// How many triangles are not shown to be covered; `halvings_max` upon each other at most.
  std::size_t Unproven(int halvings_max = 150) const {
    std::size_t unproven = 0;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (!IsCovered(i, halvings_max)) ++unproven;
    }
    return unproven;
  }

  /// The share of the surface, by area, that is shown to be covered: 1 if all of it is.
  double ProvenShare(int halvings_max = 150) const {
    double covered = 0, all = 0;
    bool is_whole = true;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const geometry::Triangle& t = mesh_.triangles[i];
      const Eigen::Vector3d u = mesh_.vertices[t[1]] - mesh_.vertices[t[0]];
      const Eigen::Vector3d v = mesh_.vertices[t[2]] - mesh_.vertices[t[0]];
      const double square = u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v);
      const double area = 0.5 * std::sqrt(std::max(square, 0.0));
      all += area;
      IsCovered(i, halvings_max) ? covered += area : is_whole = false;
    }
    return is_whole ? 1 : covered / all;
  }

  bool IsCovered(std::uint32_t triangle, int halvings_max) const {
    std::array<Corner, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& p = mesh_.vertices[mesh_.triangles[triangle][i]];
      corners[i] = {p, {Dyadic(p.x()), Dyadic(p.y()), Dyadic(p.z())}};
    }
    return IsCovered(corners, leaves_of_[triangle], halvings_max);
  }

 private:
  struct Corner {
    Eigen::Vector3d near;  ///< Rounded at each halving.
    std::array<Dyadic, 3> exact;
  };

  static bool Contains(const sphere_tree::SphereNode& node, const Corner& corner) {
    const Eigen::Vector3d d = corner.near - node.centre;
    const double excess = d.norm() - node.radius;
    // A corner halved 150 times is off by 150 · 2^-52 of the coordinates.
    const double size = corner.near.cwiseAbs().maxCoeff() + node.radius;
    if (std::abs(excess) > 1e-12 * size) return excess < 0;
    Dyadic square;
    for (int axis = 0; axis < 3; ++axis) {
      const Dyadic difference = corner.exact[axis] - Dyadic(node.centre[axis]);
      square = square + difference * difference;
    }
    return square <= Dyadic(node.radius) * Dyadic(node.radius);
  }

  /// In the leaf's ball and in all above it.
  bool IsOnWayTo(std::uint32_t leaf, const Corner& corner) const {
    for (std::uint32_t at = leaf;; at = parent_[at]) {
      if (!Contains(tree_.nodes[at], corner)) return false;
      if (at == 0) return true;
    }
  }

  bool IsCovered(const std::array<Corner, 3>& corners, const std::vector<std::uint32_t>& leaves,
                 int halvings) const {
    for (const std::uint32_t leaf : leaves) {
      if (IsOnWayTo(leaf, corners[0]) && IsOnWayTo(leaf, corners[1]) && IsOnWayTo(leaf, corners[2]))
        return true;
    }
    if (halvings == 0) return false;
    int longest = 0;
    double most = -1;
    for (int i = 0; i < 3; ++i) {
      const double length2 = (corners[(i + 1) % 3].near - corners[i].near).squaredNorm();
      if (length2 > most) most = length2, longest = i;
    }
    const Corner &a = corners[longest], &b = corners[(longest + 1) % 3];
    Corner middle;
    middle.near = 0.5 * (a.near + b.near);
    for (int axis = 0; axis < 3; ++axis)
      middle.exact[axis] = (a.exact[axis] + b.exact[axis]).Scaled(-1);
    std::array<Corner, 3> half = corners;
    half[(longest + 1) % 3] = middle;
    if (!IsCovered(half, leaves, halvings - 1)) return false;
    half = corners;
    half[longest] = middle;
    return IsCovered(half, leaves, halvings - 1);
  }

  const geometry::TriangleMesh& mesh_;
  const sphere_tree::SphereTree& tree_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::vector<std::uint32_t>> leaves_of_;
};

}  // namespace collision
