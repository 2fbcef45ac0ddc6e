// Boxes around the triangles of a mesh, for the builders of sphere trees.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/geometry/triangle/point_triangle.h"
#include "collision_core/geometry/triangle/ray_passage.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/sphere_tree/underflow.h"

namespace collision::sphere_tree {

/// The nearest point of a surface, approximately: in plain doubles without an error bound, for
/// searches only.
struct NearPoint {
  double distance = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  ElementIndex triangle;
};

/// What a ray from a surface meets; without an error bound as well.
struct RayCast {
  double first = 0;  ///< How far the first triangle is; the boxes' diagonal if there is none.
  int winding = 0;   ///< Passages through backs less those through fronts.
};

/// A tree of boxes, halved at the median until few triangles are left: the same for the same mesh,
/// whatever the library. The mesh must outlive it. Not thread-safe: it counts its work.
class TriangleBoxTree {
 public:
  /// Unchecked: IsWellFormed(mesh). BuildFitted() checks it.
  explicit TriangleBoxTree(const geometry::TriangleMesh& mesh);

  /// Returns an approximately nearest point. `hint`: a triangle that may be near. The search ends
  /// at a point no farther than `enough`, and ignores points that are nearer by less than `slack`.
  NearPoint Nearest(const Eigen::Vector3d& point, ElementIndex hint, double enough,
                    double slack) const;

  /// Casts a ray from a point of the triangle `start` along a unit direction; `start` is skipped.
  RayCast Walk(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
               ElementIndex start) const;

  /// Calls `visit(triangle)` for every triangle but those certainly farther than *limit, which may
  /// become less on the way.
  ///
  /// The corners of boxes are exact. The computed square of the distance to a box is off by a
  /// relative 5 u at most, u = 2^−53 (one for each difference, twice; one for each square, two for
  /// the sums), that of the limit by u; kSquareUnderflow covers what underflows.
  template <typename Visit>
  void VisitWithin(const Eigen::Vector3d& point, const double* limit, const Visit& visit) const {
    VisitIf(
        [&](const Node& node) {
          return SquareTo(node, point) <=
                 *limit * *limit * numeric::kSomeRoundingsUp + kSquareUnderflow;
        },
        visit);
  }

  /// Calls `visit(triangle)` for every triangle that a ray along +x (kForward) or −x (kBackward)
  /// may meet; exact.
  template <typename Visit>
  void VisitAlongX(const Eigen::Vector3d& from, geometry::Passing side, const Visit& visit) const {
    const bool forward = side == geometry::Passing::kForward;
    VisitIf(
        [&](const Node& node) {
          const bool is_ahead = forward ? node.upper.x() >= from.x() : node.lower.x() <= from.x();
          return is_ahead && node.lower.y() <= from.y() && from.y() <= node.upper.y() &&
                 node.lower.z() <= from.z() && from.z() <= node.upper.z();
        },
        visit);
  }

  geometry::TrianglePoints CornersOf(ElementIndex triangle) const {
    const geometry::Triangle& t = mesh_.triangles[triangle.value()];
    return {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
  }
  const Eigen::Vector3d& lower() const { return nodes_[0].lower; }
  const Eigen::Vector3d& upper() const { return nodes_[0].upper; }
  double diagonal() const { return (upper() - lower()).norm(); }

  /// Boxes and triangles examined so far, in all queries.
  std::uint64_t work() const { return work_; }

 private:
  struct Node {
    Eigen::Vector3d lower, upper;
    std::uint32_t first = 0;  ///< A leaf's first entry in faces_; else the second child.
    std::uint32_t count = 0;  ///< Triangles of a leaf; 0: not a leaf.
  };
  struct Face {
    Eigen::Vector3d corner, to_second, to_third;
    double uu, uv, vv;       ///< Products of the two.
    Eigen::Vector3d normal;  ///< Zero: none is known.
    ElementIndex triangle;
  };

  static double SquareTo(const Node& node, const Eigen::Vector3d& p) {
    const auto beyond = [](double below, double above) {
      const double most = below > above ? below : above;
      return most > 0 ? most : 0.0;
    };
    const double x = beyond(node.lower.x() - p.x(), p.x() - node.upper.x());
    const double y = beyond(node.lower.y() - p.y(), p.y() - node.upper.y());
    const double z = beyond(node.lower.z() - p.z(), p.z() - node.upper.z());
    return (x * x + y * y) + z * z;
  }

  template <typename Enter, typename Visit>
  void VisitIf(const Enter& enter, const Visit& visit) const {
    std::uint32_t stack[kDepthMax];
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::uint32_t at = stack[--size];
      const Node& node = nodes_[at];
      ++work_;
      if (!enter(node)) continue;
      if (node.count == 0) {
        stack[size++] = node.first;
        stack[size++] = at + 1;
      }
      work_ += node.count;
      for (std::uint32_t i = 0; i < node.count; ++i) visit(faces_[node.first + i].triangle);
    }
  }

  void Divide(std::span<ElementIndex> triangles);
  void MakeFaces(std::span<const ElementIndex> triangles, Node* leaf);
  static void TryFace(const Face& face, const Eigen::Vector3d& point, double* best2,
                      NearPoint* best);

  /// Of the stack of a traversal: 2^32 triangles are halved at most 32 times, and each halving
  /// leaves one sibling on it.
  static constexpr std::size_t kDepthMax = 40;

  const geometry::TriangleMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<Face> faces_;
  IndexedVector<ElementIndex, std::uint32_t> place_;  ///< Of each triangle in faces_.
  mutable std::uint64_t work_ = 0;
};

}  // namespace collision::sphere_tree
